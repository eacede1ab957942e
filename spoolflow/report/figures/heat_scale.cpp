#include "spoolflow/report/figures/heat_scale.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "spoolflow/report/text/html_text.hpp"

namespace spoolflow::report {

std::string colour_key(const std::string& look, const std::string& text) {
  return fmt::format(
      R"(<span><svg viewBox="0 0 16 12" aria-hidden="true"><rect width="16" height="12" {}/></svg>{}</span>)", look,
      html_text(text));
}

int HeatScale::colour(double value) const {
  return static_cast<int>(std::upper_bound(from_.begin(), from_.end(), value) - from_.begin()) - 1;
}

std::string HeatScale::legend(const std::string& title) const {
  std::string out = "<div class=\"heat\"><span>" + html_text(title) + ":</span>";
  for (std::size_t h = 0; h < from_.size(); ++h) {
    out += colour_key(fmt::format("class=\"h{}\"", h), h + 1 < from_.size()
                                                           ? fmt::format("{:g} to {:g}", from_[h], from_[h + 1])
                                                           : fmt::format("above {:g}", from_[h]));
  }
  return out + "</div>";
}

}  // namespace spoolflow::report
