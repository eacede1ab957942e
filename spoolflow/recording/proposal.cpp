#include "spoolflow/recording/proposal.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <optional>
#include <set>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "spoolflow/recording/channels/allowed_names.hpp"
#include "spoolflow/recording/channels/channel_unit.hpp"
#include "spoolflow/recording/files/header_name.hpp"
#include "spoolflow/units/unit.hpp"

namespace spoolflow::recording {
namespace {

/// Words by which people call a channel, in English, German, French, Italian, Spanish and Japanese in Latin letters;
/// accents are left out. The longer match wins.
struct Words {
  Channel channel;
  std::array<std::string_view, 26> words;
};
constexpr std::array<Words, 19> vocabulary{{
    {Channel::time, {"time", "t", "zeit", "timestamp", "seconds", "temps", "tempo", "tiempo", "jikan", "zeitstempel"}},
    {Channel::current,
     {"current", "i", "strom", "isol", "icoil", "coilcurrent", "courant", "corrente", "corriente", "denryu",
      "spulenstrom", "magnetstrom", "ventilstrom", "solenoidcurrent", "valvecurrent", "courantbobine",
      "correntebobina"}},
    {Channel::current_set,
     {"currentset", "iset", "icmd", "sollstrom", "isoll", "currentcommand", "consignecourant", "stromsoll"}},
    {Channel::voltage,
     {"voltage", "u", "v", "spannung", "usol", "ucoil", "coilvoltage", "tension", "tensione", "voltaje", "denatsu",
      "spulenspannung", "tensionbobine"}},
    {Channel::current_a, {"currenta", "ia", "stroma", "isola", "icoila", "coilcurrenta", "couranta"}},
    {Channel::current_b, {"currentb", "ib", "stromb", "isolb", "icoilb", "coilcurrentb", "courantb"}},
    {Channel::voltage_a, {"voltagea", "ua", "va", "spannunga", "usola", "ucoila", "coilvoltagea", "tensiona"}},
    {Channel::voltage_b, {"voltageb", "ub", "vb", "spannungb", "usolb", "ucoilb", "coilvoltageb", "tensionb"}},
    {Channel::position,
     {"position",    "x",         "lvdt",        "weg",    "stroke",   "spool",  "spoolposition", "pos",
      "xist",        "posizione", "posicion",    "corsa",  "carrera",  "course", "ichi",          "deplacement",
      "spostamento", "kolbenweg", "schieberweg", "xspool", "spoolpos", "hub",    "ventilhub"}},
    {Channel::position_set,
     {"positionset", "xset", "xsoll", "xcmd", "setpoint", "sollwert", "positioncommand", "xs", "consigne",
      "consigneposition", "riferimento", "consigna", "wegsoll"}},
    {Channel::force,
     {"force", "f", "kraft", "loadcell", "fmag", "magneticforce", "forza", "fuerza", "chikara", "magnetkraft",
      "effort"}},
    {Channel::axial_force, {"axialforce", "fax", "axialkraft", "forceaxiale", "forzaassiale", "fuerzaaxial"}},
    {Channel::pressure_upstream,
     {"pressureupstream", "p1", "pp", "pressurep", "pupstream", "pu", "pressionamont", "pressionemonte",
      "presionaguasarriba", "inletpressure", "supplypressure", "druckvor"}},
    {Channel::pressure_downstream,
     {"pressuredownstream", "p2", "pb", "pressureb", "pdownstream", "pd", "pressionaval", "pressionevalle",
      "presionaguasabajo", "outletpressure", "drucknach"}},
    {Channel::pressure_difference,
     {"pressuredifference", "dp", "deltap", "pdiff", "druckdifferenz", "differenzdruck", "differentialpressure",
      "pressuredrop", "differencedepression", "pertedecharge", "pressionedifferenziale", "presiondiferencial",
      "saatsu"}},
    {Channel::pressure_difference_set, {"pressuredifferenceset", "dpset", "dpsoll"}},
    {Channel::oil_temperature,
     {"oiltemperature", "temperature", "temp", "toil", "temperatur", "oeltemperatur", "t", "oiltemp", "oeltemp", "toel",
      "thetaoil", "thetaoel", "temperaturehuile", "temperaturaaceite", "temperaturaolio", "temperatura", "yuon",
      "thuile", "tolio"}},
    {Channel::flow,
     {"flow", "q", "flowrate", "volumenstrom", "qmeas", "debit", "portata", "caudal", "ryuryo", "durchfluss"}},
    {Channel::flow_reference,
     {"flowreference", "qref", "flowmeter", "referenceflow", "debitreference", "portatariferimento",
      "caudalreferencia"}},
}};

/// Letters with accents, and Greek ones of formulas, as they are typed without them.
constexpr std::array<std::pair<std::string_view, std::string_view>, 26> plain_letters{{
    {"\xC3\xA4", "ae"},    {"\xC3\xB6", "oe"}, {"\xC3\xBC", "ue"}, {"\xC3\x84", "ae"},    {"\xC3\x96", "oe"},
    {"\xC3\x9C", "ue"},    {"\xC3\x9F", "ss"}, {"\xC3\xA9", "e"},  {"\xC3\xA8", "e"},     {"\xC3\xAA", "e"},
    {"\xC3\x89", "e"},     {"\xC3\xA0", "a"},  {"\xC3\xA1", "a"},  {"\xC3\xA2", "a"},     {"\xC3\xAD", "i"},
    {"\xC3\xB3", "o"},     {"\xC3\xBA", "u"},  {"\xC3\xB1", "n"},  {"\xC3\xA7", "c"},     {"\xC3\xB2", "o"},
    {"\xC3\xB9", "u"},     {"\xC3\xAC", "i"},  {"\xCE\x94", "d"},  {"\xE2\x88\x86", "d"}, {"\xCF\x91", "theta"},
    {"\xCE\xB8", "theta"},
}};

/// A column's name taken apart: "I_sol [mA]" is "isol" with unit "mA".
struct NameParts {
  std::string word;
  std::string unit;
  bool capital = false;  ///< begins with a capital letter
  std::vector<std::string> words{};
};

std::string letters_of(std::string_view text) {
  std::string out;
  for (std::size_t at = 0; at < text.size(); ++at) {
    const auto accent =
        std::ranges::find_if(plain_letters, [&](const auto& each) { return text.substr(at).starts_with(each.first); });
    if (accent != plain_letters.end()) {
      out += accent->second;
      at += accent->first.size() - 1;
    } else if (std::isalnum(static_cast<unsigned char>(text[at])) != 0) {
      out += static_cast<char>(std::tolower(static_cast<unsigned char>(text[at])));
    }
  }
  return out;
}

/// Less what numbers the inputs of a recorder: "ch3: Position", "B: Position" and "Current - Plot 0".
std::string without_inputs(std::string_view name) {
  constexpr std::array<std::string_view, 6> inputs{"ch", "channel", "kanal", "plot", "ai", "trace"};
  constexpr std::string_view gaps = " :;,-";
  std::string out;
  bool after_input = false;
  for (std::size_t at = 0; at < name.size();) {
    const std::size_t end = std::min(name.find_first_of(gaps, at), name.size());
    const std::string word = letters_of(name.substr(at, end - at));
    const std::string input = word.substr(0, word.find_first_of("0123456789"));
    const bool number = !word.empty() && input.empty() && word.find_first_not_of("0123456789") == std::string::npos;
    const bool lettered = at == 0 && word.size() == 1 && end < name.size() && name[end] == ':';
    const bool is_input = lettered || std::ranges::count(inputs, input) > 0;
    if (!is_input && !(number && after_input)) out += std::string(name.substr(at, end - at)) + " ";
    if (!word.empty()) after_input = is_input;
    at = end + 1;
  }
  return letters_of(out).empty() ? std::string(name) : out;
}

NameParts parts_of(const std::string& name, const std::string& given_unit) {
  const NameAndUnit split = split_unit(name);
  std::string stem(split.stem.substr(0, split.stem.find_first_of("[(")));
  const std::size_t last = stem.find_last_of("./");  // the last part of a struct or group path
  if (last != std::string::npos && last + 1 < stem.size()) stem.erase(0, last + 1);
  NameParts out{"", given_unit.empty() ? std::string(split.unit) : given_unit,
                !stem.empty() && std::isupper(static_cast<unsigned char>(stem.front())) != 0};
  for (std::size_t at = stem.find('_'); at != std::string::npos && out.unit.empty(); at = stem.find('_', at + 1)) {
    for (const std::size_t end : {stem.size(), stem.find('_', at + 1)}) {
      const std::string_view word = std::string_view(stem).substr(at + 1, end - at - 1);
      const bool alone = end == stem.size();  // among other words a letter is none
      if (at == 0 || end == std::string::npos || !units::unit_named(word) || !(alone || word.size() > 1)) continue;
      if (!alone && word == "in") continue;
      out.unit = word;
      stem.resize(at);
      break;
    }
  }
  out.word = letters_of(without_inputs(stem));
  out.words = words_of(stem);
  return out;
}

/// As it is, or less what measured values are called by.
bool names_it(const Words& entry, std::string_view word) {
  constexpr std::array<std::string_view, 10> measured{"",         "ist",  "act",   "actual", "meas",
                                                      "measured", "mess", "value", "signal", "raw"};
  return std::ranges::any_of(measured, [&](std::string_view ending) {
    if (!word.ends_with(ending)) return false;
    const std::string_view stem = word.substr(0, word.size() - ending.size());
    return !stem.empty() && std::ranges::count(entry.words, stem) > 0;
  });
}

/// Whether the unit may be the channel's: of its quantity, or a voltage (a raw sensor signal), or a share of the
/// stroke.
bool may_have(Channel channel, const std::string& unit_name) {
  const auto unit = units::unit_named(unit_name);
  if (!unit) return unit_name.empty();
  const units::Dimension wanted = dimension(channel);
  return unit->dimension == wanted ||
         (unit->dimension == units::Dimension::voltage && wanted != units::Dimension::time) ||
         (unit->dimension == units::Dimension::ratio && wanted == units::Dimension::length);
}

/// The port of a valve whose pressure a word calls: "pA", "Pressure T", "Druck P".
std::optional<Channel> port_pressure(std::string_view word) {
  constexpr std::array<std::string_view, 6> pressures{"p", "pressure", "druck", "pression", "pressione", "presion"};
  constexpr std::array<std::pair<char, Channel>, 4> ports{
      {{'p', Channel::pressure_p}, {'a', Channel::pressure_a}, {'b', Channel::pressure_b}, {'t', Channel::pressure_t}}};
  if (word.empty() || std::ranges::count(pressures, word.substr(0, word.size() - 1)) == 0) return std::nullopt;
  const auto port = std::ranges::find(ports, word.back(), &std::pair<char, Channel>::first);
  return port == ports.end() ? std::nullopt : std::optional(port->second);
}

/// Whether the pressures of all four ports have a column. Else those at P and B are before and behind one edge.
bool has_all_ports(const std::vector<NameParts>& names) {
  std::set<Channel> found;
  for (const NameParts& parts : names) {
    const auto port = port_pressure(parts.word);
    if (port && may_have(*port, parts.unit)) found.insert(*port);
  }
  return found.size() == 4;
}

/// The channel that a column is called by.
std::optional<Channel> channel_called(const NameParts& parts, bool all_ports) {
  if (const auto port = port_pressure(parts.word); all_ports && port && may_have(*port, parts.unit)) return port;
  for (const Words& entry : vocabulary) {
    if (!names_it(entry, parts.word) || !may_have(entry.channel, parts.unit)) continue;
    if (parts.word == "t" && parts.unit.empty() && parts.capital != (entry.channel == Channel::oil_temperature))
      continue;
    return entry.channel;
  }
  return std::nullopt;
}

/// A channel, and the word that stands for it.
struct ChannelWord {
  Channel channel;
  std::string word;
};

/// Of words among which others stand; nothing where they are of two channels, of a set value or of a limit.
std::optional<ChannelWord> channel_among(const NameParts& parts) {
  constexpr std::size_t least_letters = 3;
  constexpr std::array<std::string_view, 13> of_no_measurement{
      "set", "soll", "cmd", "command", "ref", "target", "limit", "error", "min", "max", "fault", "status", "offset"};
  std::optional<ChannelWord> out;
  for (const std::string& word : parts.words) {
    if (std::ranges::count(of_no_measurement, word) > 0) return std::nullopt;
    const auto entry =
        std::ranges::find_if(vocabulary, [&](const Words& each) { return std::ranges::count(each.words, word) > 0; });
    if (word.size() < least_letters || entry == vocabulary.end()) continue;
    if (out && out->channel != entry->channel) return std::nullopt;
    out = ChannelWord{entry->channel, word};
  }
  return out && may_have(out->channel, parts.unit) ? out : std::nullopt;
}

/// Of the columns that are free, see Proposal::by_word.
void propose_by_words(Proposal& out, const FileContents& contents, const std::vector<NameParts>& names,
                      const std::vector<bool>& taken) {
  const auto known = [&](Channel channel) { return out.map.sources.contains(channel); };
  std::map<Channel, std::vector<std::pair<std::size_t, std::string>>> found;
  for (std::size_t k = 0; k < names.size(); ++k) {
    const auto word = channel_among(names[k]);
    out.said.push_back(word ? std::optional(word->channel) : std::nullopt);
    if (word && !taken[k]) found[word->channel].emplace_back(k, word->word);
  }
  for (const auto& [channel, columns] : found) {
    const bool of_coils = (channel == Channel::current && known(Channel::current_a)) ||
                          (channel == Channel::voltage && known(Channel::voltage_a));
    if (channel == Channel::time || known(channel) || of_coils || columns.size() != 1) continue;
    const auto& [column, word] = columns.front();
    out.map.sources.emplace(channel, ChannelSource{contents.columns[column].name, names[column].unit});
    out.by_word.emplace(channel, word);
  }
}

/// "Current, A" is the current of coil a beside one of coil b; alone its A is the unit.
void take_lone_letter_for_unit(Proposal& out) {
  std::map<Channel, ChannelSource>& sources = out.map.sources;
  const auto lettered = sources.find(Channel::current_a);
  if (lettered == sources.end() || !lettered->second.unit.empty() || out.as_well.contains(Channel::current_a)) return;
  if (sources.contains(Channel::current_b) || sources.contains(Channel::current)) return;
  ChannelSource alone = lettered->second;
  alone.unit = "A";
  sources.erase(lettered);
  sources.emplace(Channel::current, std::move(alone));
}

}  // namespace

Proposal propose_channels(const FileContents& contents, const std::vector<bool>& numberless) {
  Proposal out;
  const auto holds_none = [&](std::size_t column) { return column < numberless.size() && numberless[column]; };
  std::set<Channel> found;  // in this pass; what one before it has found is not in question
  const auto propose = [&](Channel channel, const std::string& column, const std::string& unit) {
    if (out.map.sources.try_emplace(channel, ChannelSource{column, unit}).second) {
      found.insert(channel);
    } else if (found.contains(channel)) {
      out.as_well[channel].push_back(column);
    }
  };
  std::vector<bool> own(contents.columns.size(), false);
  std::vector<std::optional<ChannelHeader>> headers;
  for (std::size_t k = 0; k < own.size(); ++k) {
    headers.push_back(channel_header(contents.columns[k]));
    own[k] = headers[k].has_value() || holds_none(k);
  }
  for (const bool exact : {true, false}) {
    for (std::size_t k = 0; k < own.size(); ++k) {
      if (headers[k] && headers[k]->exact == exact && !holds_none(k))
        propose(headers[k]->channel, contents.columns[k].name, headers[k]->unit);
    }
  }
  std::vector<NameParts> names;
  for (const FileColumn& column : contents.columns) names.push_back(parts_of(column.leaf, column.unit));
  out.all_ports = has_all_ports(names);
  for (const bool with_unit : {true, false}) {
    found.clear();
    for (std::size_t k = 0; k < own.size(); ++k) {
      if (own[k] || names[k].unit.empty() == with_unit) continue;
      if (const auto channel = channel_called(names[k], out.all_ports)) {
        propose(*channel, contents.columns[k].name, names[k].unit);
        own[k] = true;
      }
    }
  }
  take_lone_letter_for_unit(out);
  propose_by_words(out, contents, names, own);
  return out;
}

std::string written(const ChannelMap& map, const std::map<Channel, std::string>& remarks,
                    const std::vector<Channel>& missing) {
  std::string out = "[channels]\n";
  for (const auto& [channel, source] : map.sources) {
    std::string column;
    for (const char c : source.column) {
      if (c == '"' || c == '\\') column += '\\';
      if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) {
        column += fmt::format("\\u{:04x}", static_cast<int>(c));
      } else {
        column += c;
      }
    }
    const auto unit = units::unit_named(source.unit);
    const bool raw_signal =
        unit && unit->dimension == units::Dimension::voltage && dimension(channel) != units::Dimension::voltage;
    out += fmt::format("{} = {{ column = \"{}\"", name(channel), column);
    if (channel != Channel::test) out += fmt::format(", unit = \"{}\"", source.unit.empty() ? "?" : source.unit);
    if (raw_signal) out += ", scale = 1.0, offset = 0.0, to = \"?\"";
    out += " }";
    std::string remark;
    if (const auto found = remarks.find(channel); found != remarks.end()) remark = found->second;
    if (source.unit.empty() && channel != Channel::test) {
      remark += fmt::format("{}fill in the unit: {}", remark.empty() ? "" : "; ", listed(unit_names(channel)));
    }
    std::ranges::replace_if(
        remark, [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7f; }, '?');
    if (!remark.empty()) out += "  # " + remark;
    if (raw_signal) out += "  # a sensor signal: value = scale * raw + offset, in `to`";
    out += '\n';
  }
  for (const Channel channel : missing) {
    out += fmt::format("# {} = {{ column = \"?\", unit = \"{}\" }}  # needed, and not found in the file\n",
                       name(channel), unit_names(channel).front());
  }
  return out;
}

}  // namespace spoolflow::recording
