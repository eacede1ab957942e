#include "spoolflow/report/html_page.hpp"

#include <fmt/format.h>

#include "spoolflow/report/html_text.hpp"

namespace spoolflow::report {
namespace {

/// Okabe and Ito's palette, which the colour-blind can tell apart; darker tones on white, lighter ones on black.
constexpr std::string_view style = R"css(
:root{--ink:#1c2430;--soft:#5b6675;--rule:#dde2e8;--paper:#fff;--card:#f6f8fa;--good:#0b7a4b;--bad:#b3261e;
--c0:#0072b2;--c1:#d55e00;--c2:#009e73;--c3:#cc79a7;--c4:#56799a;--c5:#b58900;--c6:#5a4fcf;--c7:#8a8f98;--c8:#aab2bd}
@media(prefers-color-scheme:dark){:root{--ink:#e6eaf0;--soft:#9aa6b5;--rule:#333c48;--paper:#12171e;--card:#1b222c;--good:#4cc38a;
--bad:#ff8a80;--c0:#56b4e9;--c1:#f0883e;--c2:#2fcf9f;--c3:#e3a1c6;--c4:#9fb8d1;--c5:#f0d060;--c6:#a49cff;--c7:#9aa3ad;--c8:#596474}}
*{box-sizing:border-box}body{margin:0;background:var(--paper);color:var(--ink);font:16px/1.55 system-ui,-apple-system,"Segoe UI",Roboto,
"Helvetica Neue",Arial,"Noto Sans",sans-serif}main{max-width:960px;margin:0 auto;padding:28px 20px 80px}h1{font-size:1.75rem;line-height:1.2;margin:.2em 0}
h2{font-size:1.3rem;margin:2.4em 0 .5em;padding-top:.6em;border-top:1px solid var(--rule)}h3{font-size:1.05rem;margin:1.8em 0 .3em}
p{margin:.5em 0}.soft{color:var(--soft)}nav{margin:1.2em 0;font-size:.92rem}nav a{color:var(--c0);margin-right:1.1em;white-space:nowrap}
.verdict{background:var(--card);border-left:5px solid var(--c0);padding:14px 18px;margin:1.2em 0;border-radius:0 6px 6px 0;font-size:1.06rem}
.tiles{display:grid;grid-template-columns:repeat(auto-fit,minmax(150px,1fr));gap:12px;margin:1em 0}.tile{background:var(--card);border-radius:8px;padding:12px 14px}
.tile b{display:block;font-size:1.55rem;font-variant-numeric:tabular-nums}.tile span{color:var(--soft);font-size:.86rem}
figure{margin:1.2em 0 1.8em}figcaption{color:var(--soft);font-size:.9rem;margin-top:.3em}svg{width:100%;height:auto;display:block;overflow:visible}
.legend{display:flex;flex-wrap:wrap;gap:4px 18px;font-size:.86rem;color:var(--soft);padding-left:62px}.key{display:inline-block;width:22px;height:0;
border-top:2.5px solid;vertical-align:middle;margin-right:6px}.key.dashed{border-top-style:dashed}.key.area{height:11px;border:0;background:currentColor;opacity:.3}
.key.dots{width:8px;height:8px;border:0;border-radius:50%;background:currentColor}
.grid{stroke:var(--rule);stroke-width:1}.zero{stroke:var(--soft);stroke-width:1}.tick{fill:var(--soft);font-size:11.5px}.label{fill:var(--ink);font-size:12.5px}
.mark{fill:var(--soft);font-size:11px}.line{fill:none;stroke:currentColor;stroke-width:1.7;stroke-linejoin:round}.thin{stroke-width:.9;opacity:.8}
.dashed{stroke-dasharray:6 4}.band{fill:currentColor;opacity:.2;stroke:none}.dot{fill:currentColor;opacity:.75}
.c0{color:var(--c0)}.c1{color:var(--c1)}.c2{color:var(--c2)}.c3{color:var(--c3)}.c4{color:var(--c4)}.c5{color:var(--c5)}.c6{color:var(--c6)}.c7{color:var(--c7)}.c8{color:var(--c8)}
.scroll{overflow-x:auto}table{border-collapse:collapse;font-size:.92rem;font-variant-numeric:tabular-nums;min-width:50%}th,td{padding:5px 12px 5px 0;
text-align:right;border-bottom:1px solid var(--rule);white-space:nowrap}th:first-child,td:first-child{text-align:left}th{color:var(--soft);font-weight:600}
code{font:.86em ui-monospace,SFMono-Regular,Menlo,Consolas,monospace;overflow-wrap:anywhere}
@media print{:root{--paper:#fff}main{max-width:none;padding:0}nav{display:none}figure,table,.verdict,.tiles{break-inside:avoid}h2,h3{break-after:avoid}}
)css";

}  // namespace

void HtmlPage::heading(std::string_view text) {
  ++sections_;
  body_ += fmt::format("<h2 id=\"s{}\">{}</h2>\n", sections_, html_text(text));
  contents_ += fmt::format("<a href=\"#s{}\">{}</a>", sections_, html_text(text));
}

void HtmlPage::subheading(std::string_view text) {
  body_ += fmt::format("<h3>{}</h3>\n", html_text(text));
}

void HtmlPage::paragraph(std::string_view text) {
  body_ += fmt::format("<p>{}</p>\n", html_text(text));
}

void HtmlPage::figure(std::string_view markup, std::string_view caption) {
  ++figures_;
  body_ += fmt::format("<figure>{}<figcaption><b>Figure {}.</b> {}</figcaption></figure>\n", markup, figures_,
                       html_text(caption));
}

void HtmlPage::table(const std::vector<std::string>& header, const std::vector<std::vector<std::string>>& rows) {
  body_ += "<div class=\"scroll\"><table><thead><tr>";
  for (const std::string& cell : header) body_ += fmt::format("<th scope=\"col\">{}</th>", html_text(cell));
  body_ += "</tr></thead><tbody>";
  for (const auto& row : rows) {
    body_ += "<tr>";
    for (const std::string& cell : row) body_ += fmt::format("<td>{}</td>", html_text(cell));
    body_ += "</tr>";
  }
  body_ += "</tbody></table></div>\n";
}

std::string HtmlPage::str() const {
  return fmt::format(
      "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><meta name=\"viewport\" "
      "content=\"width=device-width, "
      "initial-scale=1\"><title>{0}</title><style>{1}</style></head><body><main><h1>{0}</h1>\n<nav "
      "aria-label=\"Contents\">{2}</nav>\n{3}</main></body></html>\n",
      html_text(title_), style, contents_, body_);
}

}  // namespace spoolflow::report
