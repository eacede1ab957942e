#include "addons/live/site.hpp"

#include <algorithm>
#include <cctype>
#include <map>

#include <fmt/format.h>

#include "addons/live/sources/datagram.hpp"
#include "spoolflow/model/provenance.hpp"
#include "spoolflow/recording/channels/allowed_names.hpp"
#include "spoolflow/recording/toml_input.hpp"

namespace spoolflow::live {
namespace {

using recording::TomlTable;

const std::vector<std::string> source_kinds{"udp", "tcp", "mqtt", "pipe", "replay", "rig"};

/// Beside the site's file, where it is relative.
std::filesystem::path beside(const TomlTable& table, const std::string& name) {
  return name == "-" ? std::filesystem::path(name) : table.file.parent_path() / name;
}

std::string checked_id(const TomlTable& valve) {
  std::string id = valve.text("id");
  const bool plain = std::all_of(id.begin(), id.end(), [](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '-' || c == '.';
  });
  const bool dots = id.find_first_not_of('.') == std::string::npos;  // a step in the page's addresses
  if (!plain || dots || id.size() > longest_valve_id) {
    throw SiteError(fmt::format("{}: the id '{}' must be up to {} letters, digits, '_', '-' and '.'{}",
                                valve.place("id"), id, longest_valve_id, dots ? ", and not dots alone" : ""));
  }
  return id;
}

bool flag(const TomlTable& table, std::string_view key) {
  const toml::node* node = table.table.get(key);
  if (node == nullptr) return false;
  const auto value = node->value_exact<bool>();
  if (!value) throw SiteError(fmt::format("{}: '{}' in {} must be true or false", table.place(key), key, table.name));
  return *value;
}

/// Raw samples are kept in memory until an alarm asks for them.
double raw_span_s(const TomlTable& store, std::string_view key, double otherwise) {
  constexpr double longest_s = 3600;
  const double value = store.optional_number(key).value_or(otherwise);
  if (value >= 0 && value <= longest_s) return value;
  throw SiteError(fmt::format("{}: '{}' in {} is {}; give the raw samples about an alarm in s, 0 to {}",
                              store.place(key), key, store.name, value, longest_s));
}

double not_negative(const TomlTable& table, std::string_view key, double otherwise) {
  const double value = table.optional_number(key).value_or(otherwise);
  if (value < 0) {
    throw SiteError(
        fmt::format("{}: '{}' in {} is {}; it must not be negative", table.place(key), key, table.name, value));
  }
  return value;
}

Ageing read_ageing(const TomlTable& table) {
  Ageing ageing;
  table.allow_only({"edge_rounding_m", "friction_factor", "spring_relaxation", "shorted_turns_fraction",
                    "added_resistance_ohm", "after_s", "over_s"});
  rig::Wear::describe(ageing.until, [&](const rig::Parameter& about, double& value) {
    value = table.optional_number(about.name).value_or(value);
    if (value < about.min || value > about.max) {
      throw SiteError(fmt::format("{}: {} = {} lies outside {} to {} {}", table.place(about.name), about.name, value,
                                  about.min, about.max, about.unit));
    }
  });
  ageing.after_s = not_negative(table, "after_s", ageing.after_s);
  ageing.over_s = table.optional_positive("over_s").value_or(ageing.over_s);
  return ageing;
}

RigWork read_work(const TomlTable& source) {
  const std::string work = source.optional_text("work").value_or("duty");
  if (work == "duty") return RigWork::duty;
  if (work == "strokes") return RigWork::strokes;
  throw SiteError(fmt::format("{}: work is \"duty\" or \"strokes\", not \"{}\"", source.place("work"), work));
}

RigSettings read_rig(const TomlTable& source) {
  source.allow_only({"kind", "valve", "seed", "speed", "ageing", "work"});
  RigSettings rig;
  const std::string valve = source.optional_text("valve").value_or("size_6");
  rig.valve = valve.ends_with(".toml") ? rig::read_valve(beside(source, valve)) : rig::valve_preset(valve);
  rig.seed = static_cast<std::uint64_t>(not_negative(source, "seed", 1));
  rig.speed = source.optional_positive("speed").value_or(1.0);
  rig.work = read_work(source);
  if (const toml::node* ageing = source.table.get("ageing")) {
    if (!ageing->is_table()) throw SiteError(fmt::format("{}: ageing must be a table", source.place("ageing")));
    rig.ageing = read_ageing({*ageing->as_table(), source.file, "ageing"});
  }
  return rig;
}

MqttTopicSettings read_topic(const TomlTable& source) {
  MqttTopicSettings out{source.optional_text("topic").value_or("")};
  if (out.topic.find_first_of("+#") == std::string::npos) return out;
  throw SiteError(fmt::format("{}: topic is '{}'; a valve's own has no '+' or '#'", source.place("topic"), out.topic));
}

SourceSettings read_source(const TomlTable& source) {
  const std::string kind = source.text("kind");
  if (kind == "udp") {
    source.allow_only({"kind"});
    return UdpSettings{};
  }
  if (kind == "tcp") {
    source.allow_only({"kind", "listen"});
    return TcpSettings{read_address(source.text("listen"), source.place("listen"))};
  }
  if (kind == "mqtt") {
    source.allow_only({"kind", "topic"});
    return read_topic(source);
  }
  if (kind == "pipe") {
    source.allow_only({"kind", "path"});
    return PipeSettings{beside(source, source.text("path"))};
  }
  if (kind == "replay") {
    source.allow_only({"kind", "recording", "speed", "repeats"});
    return ReplaySettings{beside(source, source.text("recording")), not_negative(source, "speed", 1.0),
                          flag(source, "repeats")};
  }
  if (kind == "rig") return read_rig(source);
  throw SiteError(fmt::format("{}: unknown kind of source '{}'{}; allowed: {}", source.place("kind"), kind,
                              recording::did_you_mean(kind, source_kinds), recording::listed(source_kinds)));
}

/// Each model file once.
class Models {
 public:
  const SharedModel& read(const std::filesystem::path& file) {
    SharedModel& model = models_[file];
    if (!model.model) {
      model.model = std::make_shared<const model::Model>(model::read_model(file));
      model.sha256 = model::sha256_of_file(file);
      model.file = file;
    }
    return model;
  }

 private:
  std::map<std::filesystem::path, SharedModel> models_;
};

ValveSettings read_valve(const TomlTable& valve, Models& models) {
  valve.allow_only({"id", "model", "source", "channels"});
  const std::string id = checked_id(valve);
  const toml::table* const source = valve.table["source"].as_table();
  if (source == nullptr) {
    throw SiteError(fmt::format("{}: valve '{}' needs a source, such as source = {{ kind = \"udp\" }}",
                                recording::place_of(valve.table, valve.file), id));
  }
  const TomlTable its{*source, valve.file, fmt::format("source of '{}'", id)};
  ValveSettings out{id, models.read(beside(valve, valve.text("model"))), read_source(its)};
  if (const toml::node* channels = valve.table.get("channels")) {
    if (!channels->is_table()) throw SiteError(fmt::format("{}: channels must be a table", valve.place("channels")));
    if (std::holds_alternative<UdpSettings>(out.source)) {
      throw SiteError(
          fmt::format("{}: '{}' has channels, and its source is udp, whose datagrams hold numbers in SI units in one "
                      "order (docs/live.md); let the sender convert them, and take [valve.channels] away",
                      valve.place("channels"), id));
    }
    out.channels = recording::read_channels({*channels->as_table(), valve.file, "channels"});
  }
  return out;
}

/// What a named pipe holds reaches one reader alone. `valve_of`: those of the valves before.
void check_pipe(const TomlTable& valve, const ValveSettings& settings,
                std::map<std::filesystem::path, std::string>& valve_of) {
  const auto* const pipe = std::get_if<PipeSettings>(&settings.source);
  if (pipe == nullptr) return;
  const auto [other, is_new] = valve_of.emplace(std::filesystem::weakly_canonical(pipe->path), settings.id);
  if (is_new) return;
  throw SiteError(fmt::format(
      "{}: '{}' and '{}' read the same pipe {}, and each sample would reach one of them alone; give each a pipe of its "
      "own",
      valve.place("source"), other->second, settings.id, pipe->path.string()));
}

std::vector<std::string> texts(const TomlTable& table, std::string_view key) {
  if (!table.table.contains(key)) return {};
  if (auto out = table.list_of_texts(key)) return std::move(*out);
  throw SiteError(fmt::format("{}: '{}' must be a list of texts, such as [\"192.168.0.7\"]", table.place(key), key));
}

void read_parts(const TomlTable& top, SiteSettings& site) {
  const auto part = [&](const char* key) -> std::optional<TomlTable> {
    const toml::node* node = top.table.get(key);
    if (node == nullptr) return std::nullopt;
    if (!node->is_table()) throw SiteError(fmt::format("{}: {} must be a table", top.place(key), key));
    return TomlTable{*node->as_table(), top.file, fmt::format("[{}]", key)};
  };
  if (const auto page = part("page")) {
    site.page = read_page(*page);
  }
  if (const auto alarms = part("alarms")) {
    alarms->allow_only({"raised_after_s", "gone_after_s"});
    site.alarms.raised_after_s = not_negative(*alarms, "raised_after_s", site.alarms.raised_after_s);
    site.alarms.gone_after_s = not_negative(*alarms, "gone_after_s", site.alarms.gone_after_s);
  }
  if (const auto plotjuggler = part("plotjuggler")) {
    plotjuggler->allow_only({"send_to"});
    site.plotjuggler = read_address(plotjuggler->text("send_to"), plotjuggler->place("send_to"));
  }
  if (const auto can = part("can")) site.can = read_can(*can);
  if (const auto modbus = part("modbus")) site.modbus = read_modbus(*modbus);
  if (const auto mqtt = part("mqtt")) site.mqtt = read_mqtt(*mqtt);
  if (const auto fleet = part("fleet")) site.fleet = read_publish(*fleet);
  if (const auto store = part("store")) {
    store->allow_only({"file", "keep_days", "largest_MB", "raw_before_s", "raw_after_s"});
    if (const auto file = store->optional_text("file")) site.store = beside(*store, *file).string();
    site.retention.days = store->optional_positive("keep_days").value_or(site.retention.days);
    site.raw_before_s = raw_span_s(*store, "raw_before_s", site.raw_before_s);
    site.raw_after_s = raw_span_s(*store, "raw_after_s", site.raw_after_s);
    site.retention.largest_MB = store->optional_positive("largest_MB").value_or(site.retention.largest_MB);
  }
  if (const auto sources = part("sources")) {
    sources->allow_only({"udp", "allow", "mqtt", "stalled_after_s"});
    if (const toml::node* mqtt = sources->table.get("mqtt")) {
      if (!mqtt->is_table()) throw SiteError(fmt::format("{}: mqtt must be a table", sources->place("mqtt")));
      site.mqtt_source = read_mqtt_source({*mqtt->as_table(), top.file, "[sources.mqtt]"});
    }
    if (const auto udp = sources->optional_text("udp")) site.udp = read_address(*udp, sources->place("udp"));
    for (const std::string& host : texts(*sources, "allow"))
      site.allow.push_back(read_host(host, sources->place("allow")));
    site.stalled_after_s = sources->optional_positive("stalled_after_s").value_or(site.stalled_after_s);
  }
}

std::vector<NotifySettings> read_notified(const TomlTable& top) {
  std::vector<NotifySettings> out;
  const toml::node* const node = top.table.get("notify");
  if (node == nullptr) return out;
  if (!node->is_array_of_tables()) {
    throw SiteError(
        fmt::format("{}: who gets messages of alarms are tables [[notify]] with webhook, or mail, from and to",
                    top.place("notify")));
  }
  for (const toml::node& one : *node->as_array()) out.push_back(read_notify({*one.as_table(), top.file, "[[notify]]"}));
  return out;
}

/// Each valve whose source is mqtt has its topic then.
void give_topics(SiteSettings& site, const std::filesystem::path& file) {
  std::map<std::string, std::string> valve_of;
  for (ValveSettings& valve : site.valves) {
    auto* const mqtt = std::get_if<MqttTopicSettings>(&valve.source);
    if (mqtt == nullptr) continue;
    if (!site.mqtt_source) {
      throw SiteError(
          fmt::format("{}: the source of '{}' is mqtt, and no broker is given; write [sources.mqtt] with "
                      "broker = \"tcp://HOST:1883\" and topic = \"hall_3/+/samples\"",
                      file.string(), valve.id));
    }
    const std::string& pattern = site.mqtt_source->topic;
    if (mqtt->topic.empty() && pattern.empty()) {
      throw SiteError(fmt::format("{}: '{}' has no topic; give its source one, or [sources.mqtt] one for all",
                                  file.string(), valve.id));
    }
    if (mqtt->topic.empty()) mqtt->topic = std::string(pattern).replace(pattern.find('+'), 1, valve.id);
    const auto [other, is_new] = valve_of.emplace(mqtt->topic, valve.id);
    if (!is_new) {
      throw SiteError(fmt::format("{}: '{}' and '{}' have the topic '{}' both; give one another", file.string(),
                                  other->second, valve.id, mqtt->topic));
    }
  }
}

/// What must hold between the parts.
void check(const SiteSettings& site, const std::filesystem::path& file) {
  std::vector<std::string> ids;
  const auto check_reach = [&](const Address& address, std::string_view what) {
    if (address.is_loopback() || !site.allow.empty()) return;
    throw SiteError(fmt::format(
        "{}: {} listens at {}, which other machines reach, and nothing says who may send; list the senders' "
        "addresses as allow = [\"192.168.0.7\"] in [sources]",
        file.string(), what, address.text()));
  };
  if (site.udp) check_reach(*site.udp, "udp");
  for (const ValveSettings& valve : site.valves) {
    if (std::find(ids.begin(), ids.end(), valve.id) != ids.end()) {
      throw SiteError(fmt::format("{}: two valves have the id '{}'; rename one", file.string(), valve.id));
    }
    ids.push_back(valve.id);
    if (const auto* tcp = std::get_if<TcpSettings>(&valve.source)) check_reach(tcp->listen, valve.id);
    if (std::holds_alternative<UdpSettings>(valve.source) && !site.udp) {
      throw SiteError(
          fmt::format("{}: the source of '{}' is udp, and no address is given where datagrams arrive; write "
                      "udp = \"127.0.0.1:7700\" in [sources]",
                      file.string(), valve.id));
    }
  }
  if (site.can) check_valves(*site.can, ids, file);
}

}  // namespace

std::string_view kind(const SourceSettings& source) {
  return source_kinds[source.index()];
}

SiteSettings read_site(const std::filesystem::path& file) {
  const toml::table document = recording::read_toml(file);
  const TomlTable top{document, file, "the file"};
  top.allow_only(
      {"page", "store", "sources", "alarms", "plotjuggler", "can", "modbus", "mqtt", "fleet", "notify", "valve"});
  SiteSettings site;
  read_parts(top, site);
  site.notify = read_notified(top);
  const toml::array* const valves = document["valve"].as_array();
  if (valves == nullptr || valves->empty()) {
    throw SiteError(
        fmt::format("{}: holds no valve; a site has tables [[valve]] with id, model and source", file.string()));
  }
  Models models;
  std::map<std::filesystem::path, std::string> valve_of_pipe;
  for (const toml::node& valve : *valves) {
    if (!valve.is_table()) throw SiteError(fmt::format("{}: valve must be a table [[valve]]", file.string()));
    const TomlTable table{*valve.as_table(), file, "[[valve]]"};
    site.valves.push_back(read_valve(table, models));
    check_pipe(table, site.valves.back(), valve_of_pipe);
  }
  give_topics(site, file);
  check(site, file);
  return site;
}

}  // namespace spoolflow::live
