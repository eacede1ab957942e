#include "spoolflow/export/parameters/parameter_image.hpp"

#include <array>
#include <bit>
#include <cstring>
#include <functional>
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "spoolflow/estimation/recordings/sensor_channels.hpp"
#include "spoolflow/export/number_groups.hpp"
#include "spoolflow/export/parameters/image_summary.hpp"
#include "spoolflow/model/describe_condensed.hpp"
#include "spoolflow/model/describe_observer.hpp"
#include "spoolflow/numerics/crc32.hpp"
#include "spoolflow/sensor/parameter_image/parameters_from.hpp"
#include "tests/export/exported_folder.hpp"

namespace spoolflow::exports {
namespace {

using sensor::ImageHeader;
using sensor::ImageRefusal;
using ::testing::HasSubstr;

constexpr ImageContents as_of_2023{"1.2.3", 1700000000U};

/// An image where a sensor may read it, and what is made of it.
class Page {
 public:
  explicit Page(const std::string& image) : words_(image.size() / sizeof(std::uint64_t)) {
    std::memcpy(words_.data(), image.data(), image.size());
  }
  [[nodiscard]] ImageHeader& header() { return *reinterpret_cast<ImageHeader*>(words_.data()); }
  template <class T>
  [[nodiscard]] T& at(std::size_t offset) {
    return *reinterpret_cast<T*>(bytes() + offset);
  }
  [[nodiscard]] char* bytes() { return reinterpret_cast<char*>(words_.data()); }
  [[nodiscard]] std::size_t size() const { return words_.size() * sizeof(std::uint64_t); }
  /// The sum of what the bytes have become.
  void seal() {
    std::string summed(bytes(), header().total_bytes);
    summed.erase(offsetof(ImageHeader, crc32), sizeof(std::uint32_t));
    header().crc32 = numerics::crc32({reinterpret_cast<const std::uint8_t*>(summed.data()), summed.size()});
  }
  [[nodiscard]] ImageRefusal taken() { return parameters_from(words_.data(), size(), valve); }

  sensor::ValveParameters valve;

 private:
  std::vector<std::uint64_t> words_;
};

Page page_of(const model::Model& model) {
  return Page(parameter_image(model, as_of_2023));
}

TEST(ParameterImage, NamesItsValveAndTheToolThatMadeIt) {
  Page page = page_of(example_model());
  ASSERT_EQ(page.taken(), ImageRefusal::none);
  const ImageHeader& header = *page.valve.header;
  EXPECT_EQ(std::string(header.valve_name), example_model().valve.name.substr(0, 63));
  EXPECT_STREQ(header.direction, "b");
  EXPECT_STREQ(header.tool_version, "1.2.3");
  EXPECT_EQ(header.created_s, 1700000000U);
  EXPECT_FLOAT_EQ(header.stroke_m, static_cast<float>(example_model().valve.stroke_m));
  const ImageSummary summary = image_summary({page.bytes(), page.size()});
  EXPECT_EQ(creation_text(summary.header), "2023-11-14T22:13:20Z");
  EXPECT_EQ(summary.crc32, header.crc32);
  EXPECT_EQ(summary.problem, "");
  EXPECT_EQ(sensors_text(summary.header), "observer, condensed, of one direction");
  EXPECT_THAT(ExportedFolder(example_model()).content("valve_model.hpp"), HasSubstr(sha256_text(summary.header)));
}

TEST(ParameterImage, HasTheSameBytesEachTimeAndPointsIntoThem) {
  const model::Model model = whole_example_model();
  ASSERT_EQ(parameter_image(model, as_of_2023), parameter_image(model, as_of_2023));
  Page page = page_of(model);
  ASSERT_EQ(page.taken(), ImageRefusal::none);
  for (const void* table :
       {static_cast<const void*>(page.valve.condensed_b), static_cast<const void*>(page.valve.condensed_a),
        static_cast<const void*>(page.valve.observer_b), static_cast<const void*>(page.valve.observer_a)}) {
    EXPECT_GE(static_cast<const char*>(table), page.bytes() + sizeof(ImageHeader));
    EXPECT_LT(static_cast<const char*>(table), page.bytes() + page.size());
  }
  EXPECT_LE(sizeof(sensor::ValveParameters), 5 * sizeof(void*));
}

TEST(ParameterImage, AnswersAsTheExportedTableBitForBitOverARecording) {
  const model::Model model = whole_example_model();
  const ExportedFolder folder(model);
  folder.write("valve.bin", parameter_image(model, as_of_2023));
  const auto reader = estimation::open_sensor_channels(SPOOLFLOW_SOURCES "/examples/valve_a/duty_cycle_1.h5",
                                                       estimation::sensor_channels(model, {}));
  std::string run;
  recording::SampleBlock block;
  double before_s = 0;
  while (reader->next(block) && run.size() < 20 * 20000) {
    const estimation::Columns columns = estimation::sensor_columns(block);
    for (std::size_t k = 0; k < block.rows; ++k) {
      const auto in = columns[k];
      const std::array<float, 5> sample{static_cast<float>(in.time_s - before_s), static_cast<float>(in.current_A),
                                        static_cast<float>(in.voltage_V), static_cast<float>(in.position_m),
                                        static_cast<float>(in.oil_temperature_K)};
      before_s = in.time_s;
      run.append(reinterpret_cast<const char*>(sample.data()), sizeof sample);
    }
  }
  folder.write("run.bin", run);
  EXPECT_EQ(folder.run("g++ -std=c++17 -O2 -Wall -Wextra -Wpedantic -Wconversion -Wdouble-promotion -Werror "
                       "-I. " SPOOLFLOW_SOURCES "/tests/export/image_against_table.cpp -o compare && ./compare"),
            0);
}

TEST(ParameterImage, HoldsTheSensorsThatAreAskedFor) {
  ImageContents contents = as_of_2023;
  contents.condensed = false;
  Page observer(parameter_image(example_model(), contents));
  ASSERT_EQ(observer.taken(), ImageRefusal::none);
  EXPECT_EQ(observer.valve.condensed_b, nullptr);
  EXPECT_NE(observer.valve.observer_b, nullptr);
  model::Model without = example_model();
  without.observer.reset();
  Page condensed = page_of(without);
  ASSERT_EQ(condensed.taken(), ImageRefusal::none);
  EXPECT_EQ(condensed.valve.observer_b, nullptr);
  EXPECT_EQ(condensed.valve.observer_a, nullptr);
  EXPECT_THROW((void)parameter_image(without, contents), std::invalid_argument);
}

TEST(ParameterImage, IsLookedAtInSlicesAsAtOnce) {
  Page page = page_of(example_model());
  sensor::ImageCheck check;
  ASSERT_EQ(begin(check, page.bytes(), page.size()), ImageRefusal::none);
  EXPECT_EQ(found(check), ImageRefusal::check_unfinished);
  EXPECT_EQ(parameters_of(check, page.valve), ImageRefusal::check_unfinished);
  std::size_t slices = 1;
  while (!advance(check, 64)) ++slices;
  EXPECT_EQ(slices, (page.size() / 4 + 63) / 64);
  EXPECT_EQ(parameters_of(check, page.valve), ImageRefusal::none);
  // A bit of flash that falls while the sensor is at work.
  page.bytes()[page.size() / 2] ^= 1;
  ASSERT_EQ(begin(check, page.bytes(), page.size()), ImageRefusal::none);
  while (!advance(check, 64)) {
  }
  EXPECT_EQ(found(check), ImageRefusal::damaged);
}

struct Wrong {
  const char* what;
  ImageRefusal refusal;
  std::function<void(Page&)> change;
  bool seals = true;
};

sensor::ObserverParameters<float>& observer(Page& page) {
  return page.at<sensor::ObserverParameters<float>>(page.header().tables[sensor::image_observer_b].offset);
}

TEST(ParameterImage, RefusesEachDamageByItsCode) {
  const std::vector<Wrong> all{
      {"an erased page", ImageRefusal::no_image, [](Page& p) { std::memset(p.bytes(), 0xFF, p.size()); }, false},
      {"bytes in the other order", ImageRefusal::other_byte_order,
       [](Page& p) { p.header().byte_order = 0x04030201U; }},
      {"a later layout", ImageRefusal::other_layout, [](Page& p) { ++p.header().layout_version; }},
      {"double precision", ImageRefusal::other_scalar, [](Page& p) { p.header().scalar = 2; }},
      {"a longer header", ImageRefusal::wrong_sizes, [](Page& p) { p.header().header_bytes += 32; }},
      {"more bytes than there are", ImageRefusal::too_short, [](Page& p) { p.header().total_bytes += 32; }, false},
      {"a bit", ImageRefusal::damaged, [](Page& p) { p.bytes()[5000] ^= 4; }, false},
      {"a bit of the sum", ImageRefusal::damaged, [](Page& p) { p.header().crc32 ^= 4U; }, false},
      {"a table over the end", ImageRefusal::wrong_sizes, [](Page& p) { p.header().tables[0].offset += 32; }},
      {"a table at the end of all addresses", ImageRefusal::wrong_sizes,
       [](Page& p) { p.header().tables[0].offset = 0xFFFFFFE0U; }},
      {"a table in the header", ImageRefusal::wrong_sizes, [](Page& p) { p.header().tables[2].offset = 32; }},
      {"a table between two words", ImageRefusal::wrong_sizes, [](Page& p) { p.header().tables[2].offset += 2; }},
      {"a shorter table", ImageRefusal::wrong_sizes, [](Page& p) { p.header().tables[2].bytes -= 4; }},
      {"a sensor that is promised", ImageRefusal::wrong_sizes, [](Page& p) { p.header().sensors |= 4U; }},
      {"a sensor of later days", ImageRefusal::wrong_sizes, [](Page& p) { p.header().sensors |= 8U; }},
      {"no sensor at all", ImageRefusal::wrong_sizes, [](Page& p) { p.header().sensors = 0; }},
      {"a table that no header names", ImageRefusal::wrong_sizes, [](Page& p) { p.header().sensors = 1; }},
      {"a name without an end", ImageRefusal::no_text,
       [](Page& p) { std::memset(p.header().valve_name, 'A', sizeof p.header().valve_name); }},
      {"an infinite number", ImageRefusal::not_finite,
       [](Page& p) { observer(p).spring.curve.values[3] = std::numeric_limits<float>::infinity(); }},
      {"no number", ImageRefusal::not_finite,
       [](Page& p) { observer(p).edge.friction_N.values[3] = std::numeric_limits<float>::quiet_NaN(); }},
      {"an axis that falls", ImageRefusal::axis_not_rising,
       [](Page& p) { observer(p).spring.curve.axis.spacing *= -1.0F; }},
      {"an axis of two steps", ImageRefusal::axis_not_rising,
       [](Page& p) { observer(p).edge.position_m.per_spacing *= 1.1F; }},
      {"a spool without mass", ImageRefusal::not_physical, [](Page& p) { observer(p).moving_mass_kg = 0.0F; }},
      {"a flux that falls", ImageRefusal::not_physical,
       [](Page& p) { observer(p).actuator.coil.flux_linkage.map.values.back() = -1.0F; }},
      {"stops that do not ascend", ImageRefusal::not_physical,
       [](Page& p) { observer(p).actuator.coil.hysteresis.threshold[1] = 1e-9F; }},
  };
  const Page sound = page_of(example_model());
  for (const Wrong& wrong : all) {
    Page page = sound;
    wrong.change(page);
    if (wrong.seals) page.seal();
    EXPECT_EQ(page.taken(), wrong.refusal) << wrong.what;
    EXPECT_EQ(page.valve.header, nullptr) << wrong.what;
    EXPECT_EQ(page.valve.observer_b, nullptr) << wrong.what;
    EXPECT_EQ(image_summary({page.bytes(), page.size()}).refusal, wrong.refusal) << wrong.what;
    EXPECT_STRNE(text_of(wrong.refusal), text_of(ImageRefusal::none));
  }
}

TEST(ParameterImage, RefusesAnAddressBetweenWordsAndAPageThatEnds) {
  Page page = page_of(example_model());
  EXPECT_EQ(parameters_from(page.bytes() + 4, page.size() - 4, page.valve), ImageRefusal::misaligned);
  EXPECT_EQ(parameters_from(page.bytes(), page.size() - 1, page.valve), ImageRefusal::too_short);
  EXPECT_EQ(parameters_from(page.bytes(), sizeof(ImageHeader) - 1, page.valve), ImageRefusal::too_short);
  EXPECT_EQ(parameters_from(nullptr, 0, page.valve), ImageRefusal::too_short);
  EXPECT_EQ(image_summary({}).refusal, ImageRefusal::too_short);
  EXPECT_EQ(parameters_from(std::as_bytes(std::span(page.bytes(), page.size())), page.valve), ImageRefusal::none);
}

TEST(ParameterImage, OfAPageThatIsLargerTakesItsBeginning) {
  std::string page_bytes = parameter_image(example_model(), as_of_2023);
  page_bytes.resize(1 << 17, '\xFF');
  Page page(page_bytes);
  EXPECT_EQ(page.taken(), ImageRefusal::none);
}

TEST(ParameterImage, CutsALongNameBetweenLetters) {
  model::Model model = example_model();
  model.valve.name = std::string(62, 'v') + "\u00e4";
  Page page = page_of(model);
  ASSERT_EQ(page.taken(), ImageRefusal::none);
  EXPECT_EQ(std::string(page.valve.header->valve_name), std::string(62, 'v'));
}

/// The numbers of both sensors in their order, with what each group of them means.
std::uint32_t layout_sum() {
  const auto condensed = std::make_unique<sensor::CondensedTables<double>>();
  const auto observer = std::make_unique<sensor::ObserverParameters<double>>();
  std::string layout;
  const auto add = [&layout](const NumberGroups& groups, std::size_t bytes) {
    for (const NumberGroup& group : groups.in_order(bytes / sizeof(double)))
      layout += std::to_string(group.first) + " " + std::to_string(group.count) + " " + group.meaning + "\n";
  };
  NumberGroups of_condensed(condensed.get()), of_observer(observer.get());
  model::describe_condensed_tables(*condensed, of_condensed);
  model::describe_observer(*observer, of_observer);
  add(of_condensed, sizeof *condensed);
  add(of_observer, sizeof *observer);
  return numerics::crc32({reinterpret_cast<const std::uint8_t*>(layout.data()), layout.size()});
}

TEST(ParameterImage, HasALayoutVersionThatGrowsWithTheSensorsStructures) {
  // Where this fails the sensors' structures have changed: make image_layout_version one more, and this sum the new
  // one.
  ASSERT_EQ(sensor::image_layout_version, 6U);
  EXPECT_EQ(layout_sum(), 848700030U);
}

}  // namespace
}  // namespace spoolflow::exports
