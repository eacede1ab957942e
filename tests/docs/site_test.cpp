/// The pages under docs/ hang together and name what exists.
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <stdexcept>
#include <unistd.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "spoolflow/model/describe_condensed.hpp"
#include "spoolflow/model/describe_observer.hpp"
#include "spoolflow/recording/channels/channel.hpp"
#include "spoolflow/recording/channels/channel_unit.hpp"
#include "spoolflow/sensor/basis/status.hpp"
#include "tests/docs/markdown.hpp"
#include "tests/docs/tuning_evidence.hpp"

namespace spoolflow::docs {
namespace {

namespace fs = std::filesystem;
using ::testing::IsEmpty;

const fs::path root = SPOOLFLOW_ROOT;

std::vector<Page> all_pages() {
  std::vector<Page> pages = pages_below(root / "docs");
  for (const char* other : {"README.md", "CHANGELOG.md", "CONTRIBUTING.md", "SECURITY.md", "examples/README.md"})
    pages.push_back(read_page(root / other));
  return pages;
}

std::string in_project(const fs::path& file) {
  return fs::relative(file, root).string();
}

/// Where the link leads nowhere, why.
std::string fault_of(const Page& page, const std::string& link) {
  const std::size_t mark = link.find('#');
  const fs::path target = mark == 0 ? page.file : page.file.parent_path() / link.substr(0, mark);
  if (!fs::exists(target)) return "does not exist";
  if (mark == std::string::npos || target.extension() != ".md") return "";
  for (const std::string& heading : read_page(target).headings) {
    if (anchor(heading) == link.substr(mark + 1)) return "";
  }
  return "has no such heading";
}

TEST(Site, EveryLinkLeadsSomewhere) {
  std::vector<std::string> faults;
  std::size_t links = 0;
  for (const Page& page : all_pages()) {
    for (const std::string& link : page.links) {
      if (link.starts_with("http://") || link.starts_with("https://")) continue;
      ++links;
      const std::string fault = fault_of(page, link);
      if (!fault.empty()) faults.push_back(in_project(page.file) + ": " + link + " " + fault);
    }
  }
  EXPECT_THAT(faults, IsEmpty());
  EXPECT_GT(links, 40U);
}

TEST(Site, TheIndexNamesEveryPage) {
  std::set<fs::path> named;
  const Page index = read_page(root / "docs/README.md");
  for (const std::string& link : index.links) named.insert((root / "docs" / link).lexically_normal());
  std::vector<std::string> missing;
  for (const Page& page : pages_below(root / "docs")) {
    if (page.file != index.file && named.count(page.file.lexically_normal()) == 0)
      missing.push_back(in_project(page.file));
  }
  EXPECT_THAT(missing, IsEmpty());
}

/// Files of this project that the pages name in code, such as `spoolflow/sensor/basis/table.hpp`.
std::set<std::string> files_named(const Page& page) {
  static const std::regex file("(spoolflow|tests|bench|examples|ci|cmake|docs|web)/[A-Za-z0-9_./-]*\\.[a-z0-9]+");
  std::set<std::string> out;
  for (const std::string& word : page.code_words) {
    if (std::regex_match(word, file)) out.insert(word);
  }
  return out;
}

TEST(Site, EveryFileThatIsNamedExists) {
  std::vector<std::string> missing;
  for (const Page& page : all_pages()) {
    for (const std::string& file : files_named(page)) {
      if (!fs::exists(root / file)) missing.push_back(in_project(page.file) + ": " + file);
    }
  }
  EXPECT_THAT(missing, IsEmpty());
}

TEST(Physics, NamesEveryEquationsHeaderOfTheSensor) {
  const std::set<std::string> named = files_named(read_page(root / "docs/physics.md"));
  const std::set<std::string> no_physics{"compiler.hpp", "sample.hpp", "scalar.hpp", "status.hpp", "due.hpp"};
  std::vector<std::string> missing;
  for (const std::string folder : {"spoolflow/sensor/", "spoolflow/sensor/basis/", "spoolflow/sensor/signals/"}) {
    for (const auto& entry : fs::directory_iterator(root / folder)) {
      const std::string name = entry.path().filename().string();
      if (entry.path().extension() != ".hpp" || no_physics.count(name) > 0) continue;
      if (named.count(folder + name) == 0) missing.push_back(folder + name);
    }
  }
  EXPECT_THAT(missing, IsEmpty());
}

TEST(Troubleshooting, HasAHeadingForEveryStatusInItsOrderAndNoOther) {
  std::vector<std::string> statuses, headings;
  for (const sensor::StatusName& status : sensor::status_names) statuses.emplace_back(status.name);
  statuses.emplace_back(sensor::monitor_status_name.name);
  for (const std::string& heading : read_page(root / "docs/troubleshooting.md").headings) {
    if (heading.find(' ') == std::string::npos) headings.push_back(heading);
  }
  EXPECT_EQ(headings, statuses);
}

std::set<std::string> code_words(const char* page) {
  const Page read = read_page(root / page);
  return {read.code_words.begin(), read.code_words.end()};
}

TEST(Formats, NameEveryChannelAndUnit) {
  const std::set<std::string> named = code_words("docs/formats/channels.md");
  for (const recording::Channel channel : recording::all_channels) {
    EXPECT_EQ(named.count(std::string(recording::name(channel))), 1U) << recording::name(channel);
    for (const std::string& unit : recording::unit_names(channel)) EXPECT_EQ(named.count(unit), 1U) << unit;
  }
}

struct Keys {
  std::vector<std::string> all;
  template <class Map>
  void map(const model::TableParameter& about, const Map& /*map*/) {
    all.emplace_back(about.key);
  }
  template <class Curve>
  void curve(const model::TableParameter& about, const Curve& /*curve*/) {
    all.emplace_back(about.key);
  }
  void number(const model::Parameter& about, double /*value*/) { all.emplace_back(about.key); }
};

TEST(Formats, NameEveryKeyOfTheCondensedSensor) {
  const std::set<std::string> named = code_words("docs/formats/model.md");
  const sensor::CondensedParameters<double> parameters{};
  Keys keys;
  model::describe_condensed(parameters, keys);
  EXPECT_GE(keys.all.size(), 10U);
  for (const std::string& key : keys.all) EXPECT_EQ(named.count(key), 1U) << key;
}

/// A constant of the sensor that is the same for all valves.
struct SensorConstant {
  std::string name, place;
  bool explained;  ///< a comment stands above it, or above the constants that share it, or behind it
};

/// All that spoolflow/sensor names; `type` is a regular expression.
std::vector<SensorConstant> sensor_constants(const std::string& type) {
  const std::regex constant("inline constexpr (?:" + type + ") ([a-z]\\w*)");
  std::vector<SensorConstant> found;
  for (const auto& entry : fs::recursive_directory_iterator(root / "spoolflow/sensor")) {
    if (entry.path().extension() != ".hpp") continue;
    std::ifstream in(entry.path());
    bool explained = false;
    for (std::string line; std::getline(in, line);) {
      std::smatch match;
      if (line.starts_with("///")) {
        explained = true;
      } else if (std::regex_search(line, match, constant)) {
        found.push_back({match[1], in_project(entry.path()), explained || line.find("///<") != std::string::npos});
      } else if (!line.starts_with("inline constexpr") && !line.starts_with("template")) {
        explained = false;
      }
    }
  }
  return found;
}

TEST(Parameters, EveryConstantOfTheSensorSaysWhatItIsAndHasItsEvidence) {
  const auto evidence = read_tuning_evidence(root / "spoolflow/model/tuning_evidence.csv");
  const std::vector<SensorConstant> constants = sensor_constants("double|float|T");
  EXPECT_GE(constants.size(), 100U);
  for (const SensorConstant& constant : constants) {
    EXPECT_TRUE(constant.explained) << constant.place << ": " << constant.name << ": no comment";
    EXPECT_EQ(evidence.count(constant.name), 1U)
        << constant.place << ": " << constant.name << ": no row; bench/tuning_evidence.py --update writes it";
  }
}

/// Numbers that may have evidence beside constants: what the observer's description names.
struct Numbers {
  std::set<std::string> all;
  void number(const model::Parameter& about, double /*value*/) { all.insert(about.key); }
  template <class Values>
  void list(const model::Parameter& about, const Values& /*values*/) {
    all.insert(about.key);
  }
  template <class Axis>
  void axis(const model::AxisParameter& /*about*/, const Axis& /*axis*/, int /*points*/) {}
  template <class Table>
  void curve(const model::TableParameter& /*about*/, const Table& /*curve*/) {}
  template <class Table>
  void map(const model::TableParameter& /*about*/, const Table& /*map*/) {}
  template <class Table>
  void volume(const model::TableParameter& /*about*/, const Table& /*volume*/) {}
};

TEST(Parameters, EvidenceIsThatOfANumber) {
  Numbers numbers;
  const sensor::ObserverParameters<double> observer{};
  model::describe_observer(observer, numbers);
  for (const SensorConstant& constant : sensor_constants("\\w+")) numbers.all.insert(constant.name);
  for (const auto& [name, text] : read_tuning_evidence(root / "spoolflow/model/tuning_evidence.csv"))
    EXPECT_EQ(numbers.all.count(name), 1U) << name << ": evidence of no number";
}

TEST(TuningEvidence, IsRefusedWhereARowIsShortSaysNothingOrComesAgain) {
  const fs::path file = fs::temp_directory_path() / ("spoolflow-evidence-" + std::to_string(::getpid()) + ".csv");
  const auto read = [&](const std::string& rows) {
    std::ofstream(file) << "number,run,a,b,c,d,e,f,note\n" << rows;
    return read_tuning_evidence(file);
  };
  EXPECT_EQ(read("one,ramp,1,2,3,4,5,6,\ntwo,,,,,,,,none, as no run does it\n"),
            (std::map<std::string, std::string>{{"one", "ramp: p95 1, 2, 3 % FS, band 4, 5, 6 %"},
                                                {"two", "none, as no run does it"}}));
  for (const char* wrong : {"one,ramp,1,2,3\n", "one,,,,,,,,\n", "one,,,,,,,,a\none,,,,,,,,b\n"})
    EXPECT_THROW((void)read(wrong), std::runtime_error) << wrong;
  fs::remove(file);
}

TEST(Markdown, FindsHeadingsLinksAndCodeOutsideOfBlocks) {
  const fs::path file = fs::temp_directory_path() / ("spoolflow-page-" + std::to_string(::getpid()) + ".md");
  {
    std::ofstream out(file);
    out << "# A heading: two\n[one](a.md#b) `code](no)` [two](c.md)\n```\n# none\n[none](x.md)\n```\n";
  }
  const Page page = read_page(file);
  fs::remove(file);
  EXPECT_EQ(page.headings, std::vector<std::string>{"A heading: two"});
  EXPECT_EQ(page.links, (std::vector<std::string>{"a.md#b", "c.md"}));
  EXPECT_EQ(page.code_words, std::vector<std::string>{"code](no)"});
  EXPECT_EQ(anchor(page.headings.front()), "a-heading-two");
}

}  // namespace
}  // namespace spoolflow::docs
