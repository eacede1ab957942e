#include "addons/live/message_sources.hpp"

#include <utility>

namespace spoolflow::live {

void MessageSources::add(const std::string& topic, recording::ReadOptions channels, const SourcePosition& after,
                         Intake& intake) {
  sources_.emplace(topic, std::make_unique<MessageSource>(topic, std::move(channels), after, intake));
}

std::vector<std::string> MessageSources::topics() const {
  std::vector<std::string> out;
  if (!settings_.topic.empty()) out.push_back(settings_.topic);
  for (const auto& [topic, source] : sources_)
    if (!id_in_topic(settings_.topic, topic)) out.push_back(topic);
  return out;
}

void MessageSources::take(const std::string& topic, std::string_view payload) {
  ++messages_;
  if (const auto source = sources_.find(topic); source != sources_.end()) {
    source->second->take(payload);
    return;
  }
  ++unknown_valve_;
  unknown_.note(id_in_topic(settings_.topic, topic).value_or(""), topic);
}

void MessageSources::set_connected(bool connected, const std::string& trouble) {
  if (connected_.exchange(connected) == connected && trouble.empty()) return;
  for (const auto& [topic, source] : sources_) source->set_trouble(trouble);
}

void MessageSources::ask_to_stop() {
  for (const auto& [topic, source] : sources_) source->ask_to_stop();
}

}  // namespace spoolflow::live
