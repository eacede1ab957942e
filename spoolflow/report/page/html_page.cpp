#include "spoolflow/report/page/html_page.hpp"

#include <algorithm>
#include <stdexcept>
#include <string>

#include <fmt/format.h>

#include "spoolflow/report/figures/svg_figure.hpp"
#include "spoolflow/report/page/page_files.hpp"
#include "spoolflow/report/text/html_text.hpp"

namespace spoolflow::report {

namespace {

std::string_view bytes_of(std::string_view name) {
  const auto files = page_files();
  const auto found = std::ranges::find_if(files, [&](const EmbeddedFile& file) { return file.name == name; });
  if (found == files.end()) throw std::logic_error("the program was built without " + std::string(name));
  return found->bytes;
}

}  // namespace

std::string_view page_style() {
  return bytes_of("page.css");
}

std::string_view page_script() {
  return bytes_of("page.js");
}

namespace {

constexpr Layout wide_layout{1064, 1};
constexpr Layout narrow_layout{360, 0.85};
constexpr Layout half_layout{510, 1};

/// The browser itself refuses whatever a page would fetch.
constexpr const char* nothing_from_outside =
    "default-src 'none'; style-src 'unsafe-inline'; script-src 'unsafe-inline'; img-src data:";

}  // namespace

HtmlPage::HtmlPage(std::string kind, std::string title, std::string origin, ReaderUnits units)
    : kind_(std::move(kind)), title_(std::move(title)), origin_(std::move(origin)), units_(units) {}

void HtmlPage::headline(const Text& facts) {
  headline_ = fmt::format("<p class=\"facts\">{}</p>\n", html_text(facts.in(units_)));
}

void HtmlPage::verdict(const Text& sentence) {
  body_ += fmt::format("<p class=\"verdict\">{}</p>\n", html_text(sentence.in(units_)));
}

void HtmlPage::remarks(std::span<const Text> remarks) {
  if (remarks.empty()) return;
  body_ += "<ul class=\"limits\">";
  for (const Text& remark : remarks) body_ += "<li>" + html_text(remark.in(units_)) + "</li>";
  body_ += "</ul>\n";
}

void HtmlPage::part(std::string_view heading) {
  end_part();
  section(heading);
  in_part_ = true;
}

void HtmlPage::section(std::string_view heading) {
  if (in_part_) return subsection(std::string(heading));
  ++sections_;
  body_ += fmt::format("<h2 id=\"s{}\">{}</h2>\n", sections_, html_text(heading));
  contents_ += fmt::format("<a href=\"#s{}\">{}</a>", sections_, html_text(heading));
}

void HtmlPage::subsection(const Text& heading) {
  body_ += fmt::format("<h3>{}</h3>\n", html_text(heading.in(units_)));
}

void HtmlPage::paragraph(const Text& text) {
  body_ += fmt::format("<p>{}</p>\n", html_text(text.in(units_)));
}

void HtmlPage::note(const Text& text) {
  body_ += fmt::format("<p class=\"soft\">{}</p>\n", html_text(text.in(units_)));
}

std::string HtmlPage::caption(const Text& text) {
  return fmt::format("<figcaption><b>Figure {}.</b> {}</figcaption>", figures_, html_text(text.in(units_)));
}

std::string HtmlPage::drawings(const CaptionedFigure& figure, const Layout& layout) const {
  return fmt::format("{}<div class=\"wide\">{}</div><div class=\"narrow\">{}</div>",
                     figure.legend.empty() ? legend_of(figure.figure, units_) : figure.legend,
                     svg_of(figure.figure, layout, fmt::format("f{}w", figures_), units_),
                     svg_of(figure.figure, narrow_layout, fmt::format("f{}n", figures_), units_));
}

void HtmlPage::figure(const CaptionedFigure& figure) {
  ++figures_;
  const std::string drawing = drawings(figure, wide_layout);
  if (figure.live.empty()) {
    body_ += "<figure>" + drawing + caption(figure.caption) + "</figure>\n";
    return;
  }
  body_ += "<figure class=\"run-plots\"><div class=\"static\">" + drawing + "</div>" + caption(figure.caption) +
           "<script type=\"application/json\">" + figure.live + "</script></figure>\n";
}

void HtmlPage::pair(const std::vector<CaptionedFigure>& figures) {
  body_ += "<div class=\"pair\">";
  for (const CaptionedFigure& figure : figures) {
    ++figures_;
    body_ += "<figure>" + drawings(figure, half_layout) + caption(figure.caption) + "</figure>\n";
  }
  body_ += "</div>\n";
}

std::string HtmlPage::str() const {
  const std::string contents = "<nav aria-label=\"Contents\">" + contents_ + "</nav>";
  const std::string body =
      contents_at_ ? body_.substr(0, *contents_at_) + contents + "\n" + body_.substr(*contents_at_) : body_;
  return fmt::format(
             "<!doctype html>\n<html lang=\"en\"{6}><head><meta charset=\"utf-8\">"
             "<meta name=\"viewport\" content=\"width=device-width,initial-scale=1\">"
             "<meta http-equiv=\"Content-Security-Policy\" content=\"{0}\">"
             "<title>{1}: {2}</title><style>{3}</style></head>\n<body><main>\n"
             "<header><p class=\"kicker\">{1}</p><h1>{2}</h1>{7}<p class=\"kicker\">{4}</p>\n{5}</header>\n",
             nothing_from_outside, html_text(kind_), html_text(title_), page_style(), html_text(origin_),
             contents_at_ ? "" : contents, units_.attributes(), headline_) +
         body + "</main>\n<script>" + std::string(page_script()) + "</script></body></html>\n";
}

}  // namespace spoolflow::report
