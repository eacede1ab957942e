/// A page that the valve itself moves on is the page of the model that the host moves on.
#include "spoolflow/sensor/parameter_image/moved_page.hpp"

#include <cstring>

#include <gtest/gtest.h>

#include "spoolflow/calibration/references/wear.hpp"
#include "spoolflow/export/parameters/parameter_image.hpp"

namespace spoolflow::exports {
namespace {

using sensor::ImageRefusal;

using PageWords = std::vector<std::uint64_t>;

PageWords words_of(const model::Model& model, bool condensed = false) {
  const std::string image = parameter_image(model, {"1.2.3", 1700000000U, condensed, true});
  PageWords out(image.size() / sizeof(std::uint64_t));
  std::memcpy(out.data(), image.data(), image.size());
  return out;
}

sensor::ValveParameters accepted(const PageWords& page) {
  sensor::ValveParameters out;
  EXPECT_EQ(parameters_from(page.data(), page.size() * sizeof(std::uint64_t), out), ImageRefusal::none);
  return out;
}

/// Writes the spare page in slices of eight words.
PageWords moved_on(const PageWords& page, const sensor::PageChange& change) {
  PageWords out(page.size(), ~std::uint64_t{0});
  sensor::PageMove move;
  EXPECT_EQ(begin(move, accepted(page), change), ImageRefusal::none);
  std::uint32_t last = 0;
  while (!advance(move, 8, [&](std::uint32_t place, std::uint32_t word) {
    last = place;
    std::memcpy(reinterpret_cast<char*>(out.data()) + sizeof word * place, &word, sizeof word);
  })) {
  }
  EXPECT_EQ(last, 1U);  // the magic, so that a page that is cut off is none
  return out;
}

model::Model example_valve() {
  return model::read_model(SPOOLFLOW_EXAMPLE_MODEL);
}

TEST(MovedPage, HoldsTheNumbersOfTheModelThatTheHostMoves) {
  const model::Model model = example_valve();
  const PageWords here = moved_on(words_of(model), {0.08F, 0.012F, 14e-6F, 1700000001U});
  const PageWords there = words_of(calibration::moved(model, {0.08, 1, 14e-6, 0.012, 0}));
  ASSERT_EQ(here.size(), there.size());
  const auto* const is = reinterpret_cast<const float*>(here.data());
  const auto* const expected = reinterpret_cast<const float*>(there.data());
  std::size_t off = 0;
  for (std::size_t k = sensor::image_header_bytes / sizeof(float); k < 2 * here.size(); ++k)
    off += !(std::abs(is[k] - expected[k]) <= 2e-6F * std::abs(expected[k]) + 1e-12F);
  EXPECT_EQ(off, 0U);
  EXPECT_NE(std::memcmp(here.data(), words_of(model).data(), here.size() * sizeof(std::uint64_t)), 0);
}

TEST(MovedPage, IsTakenAsAnyOtherAndSaysByHowMuchItWasMoved) {
  const PageWords once = moved_on(words_of(example_valve()), {0.08F, 0.012F, 14e-6F, 1700000001U});
  const PageWords twice = moved_on(once, {0.05F, 0.01F, 0.0F, 1700000002U});
  const sensor::ImageHeader& header = *accepted(twice).header;
  EXPECT_FLOAT_EQ(header.adapted_edge_width, 1.08F * 1.05F - 1);
  EXPECT_FLOAT_EQ(header.adapted_position_zero_m, 14e-6F);
  EXPECT_EQ(header.adaptations, 2U);
  EXPECT_EQ(header.created_s, 1700000002U);
  EXPECT_EQ(accepted(words_of(example_valve())).header->adaptations, 0U);
}

TEST(MovedPage, RefusesWhatItCannotMove) {
  sensor::PageMove move;
  const PageWords page = words_of(example_valve()), with_condensed = words_of(example_valve(), true);
  EXPECT_EQ(begin(move, accepted(with_condensed), {0.05F, 0.01F, 0, 1700000001U}), ImageRefusal::sensor_not_held);
  EXPECT_EQ(begin(move, sensor::ValveParameters{}, {0.05F, 0.01F, 0, 1700000001U}), ImageRefusal::sensor_not_held);
  const sensor::ValveParameters valve = accepted(page);
  for (const sensor::PageChange& change : {sensor::PageChange{0.4F, 0.01F, 0, 1700000001U},
                                           {NAN, 0.01F, 0, 1700000001U},
                                           {0.05F, 0.01F, 61e-6F, 1700000001U},
                                           {0.05F, NAN, 0, 1700000001U},
                                           {0.05F, 0.01F, 0, 1700000000U}}) {
    EXPECT_EQ(begin(move, valve, change), ImageRefusal::not_physical);
    EXPECT_FALSE(advance(move, 1000, [](std::uint32_t, std::uint32_t) { ADD_FAILURE(); }));
  }
}

}  // namespace
}  // namespace spoolflow::exports
