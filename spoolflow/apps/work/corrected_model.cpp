#include "spoolflow/apps/work/corrected_model.hpp"

#include <utility>

#include "spoolflow/monitor/adaptation.hpp"

namespace spoolflow::apps {

model::Model corrected_model(const Monitored& from, const monitor::Monitor& watch) {
  model::Adaptation how{from.tool_version, model::creation_time(), from.model_sha256, {}, {}};
  model::Model before = from.model;
  for (std::size_t k = 0; k < from.recordings.size(); ++k) {
    const std::filesystem::path& recording = from.recordings[k];
    how.files.push_back(recording.filename().string());
    before.provenance.inputs.push_back({std::string(model::adaptation_protocol), recording.filename().string(),
                                        model::sha256_of_file(recording), from.samples[k]});
  }
  return monitor::adapted(before, watch.findings(), std::move(how));
}

}  // namespace spoolflow::apps
