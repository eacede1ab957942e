#include "spoolflow/report/page/reader_units.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <optional>

#include <fmt/format.h>

#include "spoolflow/report/text/number_text.hpp"

namespace spoolflow::report {
namespace {

constexpr std::string_view minus_sign = "\u2212";
constexpr std::array<ReaderQuantity, 5> quantities{{
    {"flow", {{{"L/min", "L/min"}, {"m3/h", "m\u00b3/h", 0.06}, {"gal/min", "gal/min", 1 / 3.785411784}}}},
    {"pressure", {{{"bar", "bar"}, {"MPa", "MPa", 0.1}, {"psi", "psi", 14.503773773}}}},
    {"position", {{{"mm", "mm"}, {"um", "\u00b5m", 1000}, {"in", "in", 1 / 25.4}}}},
    {"force", {{{"N", "N"}, {"lbf", "lbf", 0.224808943}, {}}}},
    {"temperature", {{{"C", "\u00b0C"}, {"F", "\u00b0F", 1.8, 32}, {}}}},
}};

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

/// A number as a page writes it, within a text.
struct Written {
  std::size_t begin, end;
  double value;
  int decimals;
};

/// The number that ends at `end`, its sign included.
std::optional<Written> number_before(std::string_view text, std::size_t end) {
  std::size_t begin = end;
  while (begin > 0 && (is_digit(text[begin - 1]) || text[begin - 1] == '.')) --begin;
  if (begin == end || !is_digit(text[begin]) || !is_digit(text[end - 1])) return std::nullopt;
  const std::string digits(text.substr(begin, end - begin));
  const std::size_t point = digits.find('.');
  Written out{begin, end, std::strtod(digits.c_str(), nullptr),
              point == std::string::npos ? 0 : static_cast<int>(digits.size() - point - 1)};
  const auto signed_by = [&](std::string_view sign) {
    return begin >= sign.size() && text.substr(begin - sign.size(), sign.size()) == sign;
  };
  if (signed_by(minus_sign)) {
    out.begin -= minus_sign.size();
    out.value = -out.value;
  } else if (begin > 0 && (std::isalnum(static_cast<unsigned char>(text[begin - 1])) != 0 || signed_by("-"))) {
    return std::nullopt;  // part of a name or of a power of ten
  }
  return out;
}

/// About as many digits as before, never fewer.
std::string converted(const Written& number, const ReaderUnit& unit) {
  const int shift = static_cast<int>(std::lround(std::log10(unit.factor)));
  return fixed(unit.factor * number.value + unit.offset, std::clamp(number.decimals - shift, 0, 9));
}

/// All numbers of a cell or a part of it.
std::string each_converted(std::string_view text, const ReaderUnit& unit) {
  std::string out;
  std::size_t done = 0;
  bool in_tag = false;
  for (std::size_t k = 0; k < text.size(); ++k) {
    if (text[k] == '<') in_tag = true;
    if (text[k] == '>') in_tag = false;
    const bool ends = is_digit(text[k]) && (k + 1 == text.size() || (!is_digit(text[k + 1]) && text[k + 1] != '.'));
    if (in_tag || !ends) continue;
    const std::optional<Written> number = number_before(text, k + 1);
    if (!number || number->begin < done) continue;
    out += text.substr(done, number->begin - done);
    out += converted(*number, unit);
    done = k + 1;
  }
  return out + std::string(text.substr(done));
}

/// The units of a title in brackets, and the title with the reader's instead.
struct Titled {
  std::string title;
  std::vector<ReaderUnit> units;
};

Titled titled(const std::string& title, const ReaderUnits& reader) {
  const std::size_t open = title.rfind('[');
  if (open == std::string::npos || title.back() != ']') return {title, {}};
  Titled out{title.substr(0, open + 1), {}};
  std::string_view rest = std::string_view(title).substr(open + 1, title.size() - open - 2);
  constexpr std::string_view between = " / ";
  while (true) {
    const std::size_t end = rest.find(between);
    out.units.push_back(reader.instead_of(rest.substr(0, end)));
    out.title += out.units.back().shown;
    if (end == std::string_view::npos) break;
    out.title += between;
    rest.remove_prefix(end + between.size());
  }
  out.title += ']';
  return out;
}

void convert(double& value, const ReaderUnit& unit) {
  value = unit.factor * value + unit.offset;
}

void convert(std::vector<double>& values, const ReaderUnit& unit) {
  for (double& value : values) convert(value, unit);
}

void convert(std::optional<double>& value, const ReaderUnit& unit) {
  if (value) convert(*value, unit);
}

}  // namespace

const std::array<ReaderQuantity, 5>& reader_quantities() {
  return quantities;
}

ReaderUnits::ReaderUnits(const std::vector<std::string>& asked) {
  std::string allowed;
  for (const ReaderQuantity& quantity : quantities) {
    for (const ReaderUnit& unit : quantity.units)
      if (!unit.asked.empty()) allowed += fmt::format("{}{}", allowed.empty() ? "" : ", ", unit.asked);
  }
  std::array<std::string_view, quantities.size()> given{};
  for (const std::string& name : asked) {
    bool known = false;
    for (std::size_t q = 0; q < quantities.size(); ++q) {
      for (std::size_t k = 0; k < quantities[q].units.size(); ++k) {
        if (name.empty() || quantities[q].units[k].asked != name) continue;
        if (!given[q].empty())
          throw UnknownUnit(
              fmt::format("--units: both {} and {} are units of {}; give one", given[q], name, quantities[q].name));
        known = true;
        given[q] = name;
        chosen_[q] = k;
      }
    }
    if (!known) throw UnknownUnit(fmt::format("--units: '{}' is none of {}", name, allowed));
  }
}

ReaderUnit ReaderUnits::instead_of(std::string_view made) const {
  for (std::size_t q = 0; q < quantities.size(); ++q) {
    if (quantities[q].units[0].shown == made) return quantities[q].units[chosen_[q]];
  }
  return {made, made};
}

std::string ReaderUnits::text(std::string_view text) const {
  std::string out;
  std::size_t done = 0;
  for (std::size_t k = 1; k < text.size(); ++k) {
    if (text[k - 1] != ' ') continue;
    for (std::size_t q = 0; q < quantities.size(); ++q) {
      const std::string_view made = quantities[q].units[0].shown;
      if (chosen_[q] == 0 || !text.substr(k).starts_with(made)) continue;
      const std::size_t after = k + made.size();
      // "mm2/s", "N/bar", "bars": another unit or no unit at all
      if (after < text.size() &&
          (std::isalnum(static_cast<unsigned char>(text[after])) != 0 || text[after] == '/' || text[after] == '\xc2'))
        continue;
      const ReaderUnit& unit = quantities[q].units[chosen_[q]];
      std::size_t begin = k - 1;
      // "5 to 70 bar", "30, 50 and 70 bar"
      for (std::size_t end = begin; const auto number = number_before(text, end);) {
        begin = number->begin;
        end = 0;
        for (const std::string_view between : {" to ", " and ", ", ", "\u2013"}) {
          if (begin >= between.size() && text.substr(begin - between.size(), between.size()) == between)
            end = begin - between.size();
        }
      }
      if (begin == k - 1 || begin < done) continue;
      out += text.substr(done, begin - done);
      out += each_converted(text.substr(begin, k - begin), unit);
      out += unit.shown;
      done = after;
    }
  }
  return out + std::string(text.substr(done));
}

std::string ReaderUnits::markup(std::string_view html) const {
  if (as_made()) return std::string(html);
  std::string out;
  while (!html.empty()) {
    const std::size_t tag = std::min(html.find('<'), html.size());
    out += text(html.substr(0, tag));
    html.remove_prefix(tag);
    std::size_t end = html.find('>');
    for (const std::string_view verbatim : {"script", "style"}) {
      if (html.substr(std::min<std::size_t>(1, html.size())).starts_with(verbatim))
        end = html.find(fmt::format("</{}>", verbatim));
    }
    end = end == std::string_view::npos ? html.size() : end + 1;
    out += html.substr(0, end);
    html.remove_prefix(end);
  }
  return out;
}

Figure ReaderUnits::of(Figure figure) const {
  if (as_made()) return figure;
  Titled across = titled(figure.x_title, *this);
  figure.x_title = across.title;
  const ReaderUnit x = across.units.empty() ? ReaderUnit{} : across.units.front();
  convert(figure.x_lowest, x);
  convert(figure.x_highest, x);
  for (AxisMark& mark : figure.x_marks) {
    convert(mark.at, x);
    if (x.factor != 1) mark.text = each_converted(mark.text, x);
  }
  for (Panel& panel : figure.panels) {
    Titled up = titled(panel.title, *this);
    panel.title = up.title;
    const ReaderUnit y = up.units.empty() ? ReaderUnit{} : up.units.front();
    convert(panel.lowest, y);
    convert(panel.highest, y);
    for (Cell& cell : panel.cells) {
      convert(cell.x_from, x);
      convert(cell.x_to, x);
      convert(cell.y_from, y);
      convert(cell.y_to, y);
    }
    for (Row& row : panel.rows) {
      for (Span& span : row.spans) {
        convert(span.from, x);
        convert(span.to, x);
      }
    }
    for (Mark& mark : panel.marks) {
      convert(mark.x, x);
      convert(mark.y, y);
      convert(mark.y_upper, y);
    }
  }
  return figure;
}

BarChart ReaderUnits::of(BarChart chart) const {
  if (as_made()) return chart;
  const Titled axis = titled(chart.axis, *this);
  chart.axis = axis.title;
  if (axis.units.empty() || axis.units.front().factor == 1) return chart;
  const ReaderUnit unit = axis.units.front();
  const auto length = [&](Bar::Length& bar) {
    bar.value *= unit.factor;
    convert(bar.lower, unit);
    convert(bar.upper, unit);
  };
  for (Bar& bar : chart.bars) {
    length(bar.solid);
    if (bar.pale) length(*bar.pale);
    bar.text = each_converted(bar.text, unit);
  }
  chart.lowest *= unit.factor;
  convert(chart.highest, unit);
  return chart;
}

HtmlTable ReaderUnits::of(HtmlTable table) const {
  if (as_made()) return table;
  for (std::size_t c = 0; c < table.columns().size(); ++c) {
    const Titled heading = titled(table.columns()[c].heading, *this);
    table.heading(c, heading.title);
    table.change_column(c, [&](const std::string& cell) {
      constexpr std::string_view between = " / ";
      std::string out;
      std::string_view rest = cell;
      for (std::size_t k = 0; k < heading.units.size(); ++k) {
        const bool last = k + 1 == heading.units.size();
        const std::size_t end = last ? std::string_view::npos : rest.find(between);
        const std::string_view part = rest.substr(0, end);
        out += heading.units[k].factor == 1 ? std::string(part) : each_converted(part, heading.units[k]);
        rest.remove_prefix(part.size());
        if (end == std::string_view::npos) break;
        out += between;
        rest.remove_prefix(between.size());
      }
      return out + std::string(rest);
    });
  }
  return table;
}

std::string ReaderUnits::attributes() const {
  std::string out;
  for (std::size_t q = 0; q < quantities.size(); ++q) {
    if (chosen_[q] != 0) out += fmt::format(" data-{}-unit=\"{}\"", quantities[q].name, chosen_[q]);
  }
  return out;
}

}  // namespace spoolflow::report
