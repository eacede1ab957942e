#include "spoolflow/report/page_style.hpp"

#include <string>

namespace spoolflow::report {
namespace {

constexpr std::string_view colours = R"css(
:root{color-scheme:light dark;--paper:#fff;--card:#f4f6f8;--ink:#17202b;--soft:#586474;--rule:#e1e6eb;--observer:#0b68b0;
--condensed:#cf5a00;--a:#0b68b0;--b:#b58900;--c:#00806a;--d:#a3478f;--ramp-a:#8fc1e3;--ramp-b:#082a54;--fault:#b3261e;
--h0:#fffbe6;--h1:#fff0b8;--h2:#fedd84;--h3:#fec04f;--h4:#f99a2c;--h5:#e57115;--h6:#bf4a06;--h7:#7c2805}
@media screen and (prefers-color-scheme:dark){:root{--paper:#0f141a;--card:#181f27;--ink:#e7ecf2;--soft:#9aa7b6;
--rule:#2a333d;--observer:#5bb5f2;--condensed:#ff9d4f;--a:#5bb5f2;--b:#e6c34a;--c:#3fc9a8;--d:#e08fcd;--ramp-a:#33597c;
--ramp-b:#d9eeff;--fault:#ff8a80;--h0:#1b2530;--h1:#2c3436;--h2:#4a4434;--h3:#74592f;--h4:#a5712d;--h5:#d68a33;
--h6:#f6ab4e;--h7:#ffdc8f}}
)css";

constexpr std::string_view text = R"css(
*{box-sizing:border-box}html{-webkit-text-size-adjust:100%}
body{margin:0;background:var(--paper);color:var(--ink);font:16px/1.55 system-ui,-apple-system,"Segoe UI",Roboto,"Helvetica Neue",Arial,sans-serif}
main{max-width:1120px;margin:0 auto;padding:34px 28px 90px}
.kicker{color:var(--soft);font-size:.85rem;letter-spacing:.02em;margin:0}
h1{font-size:1.9rem;line-height:1.15;letter-spacing:-.01em;margin:.15em 0 .1em}
h2{font-size:1.35rem;line-height:1.25;margin:3.2em 0 .4em;padding-top:.7em;border-top:2px solid var(--ink)}
h3{font-size:1.05rem;margin:2em 0 .2em}
p{margin:.5em 0;max-width:74ch}.soft{color:var(--soft);font-size:.92rem}
a{color:var(--observer)}nav{display:flex;flex-wrap:wrap;gap:2px 18px;margin:1.1em 0 0;font-size:.9rem}nav a{text-decoration:none}nav a:hover{text-decoration:underline}
.verdict{font-size:1.24rem;line-height:1.45;max-width:62ch;margin:1em 0 .6em}.verdict b{white-space:nowrap}
.limits{margin:.4em 0 1.2em;padding-left:1.2em;max-width:74ch}.limits li{margin:.3em 0}
.tiles{display:grid;grid-template-columns:repeat(auto-fit,minmax(190px,1fr));gap:12px;margin:1.4em 0}
.tile{background:var(--card);border-radius:8px;padding:12px 16px 14px}.tile b{display:block;font-size:1.7rem;line-height:1.2;font-variant-numeric:tabular-nums}
.tile span{display:block;color:var(--soft);font-size:.86rem;line-height:1.35}
.scroll{overflow-x:auto;margin:1em 0}table{border-collapse:collapse;font-size:.9rem;font-variant-numeric:tabular-nums}
th,td{padding:5px 0 5px 18px;text-align:right;border-bottom:1px solid var(--rule);vertical-align:baseline}
th{color:var(--soft);font-weight:600;font-size:.82rem;line-height:1.25;vertical-align:bottom;white-space:nowrap}
th.text,td.text{text-align:left;padding-left:0;padding-right:6px}td.text+td.text,th.text+th.text{padding-left:14px}
td{white-space:nowrap}td.wrap{white-space:normal;min-width:24ch;max-width:62ch}tr.first td{border-top:1px solid var(--soft)}
td .bar{display:inline-block;height:9px;border-radius:1px;margin-right:8px;background:currentColor;vertical-align:baseline}
td .dot{display:inline-block;width:9px;height:9px;border-radius:50%;background:currentColor;margin-right:7px}
code{font:.86em ui-monospace,SFMono-Regular,Menlo,Consolas,monospace}
.hash{font:.8rem ui-monospace,SFMono-Regular,Menlo,Consolas,monospace;overflow-wrap:anywhere;white-space:normal;min-width:17ch}
)css";

constexpr std::string_view figures = R"css(
figure{margin:1.4em 0 2.2em}figcaption{color:var(--soft);font-size:.9rem;line-height:1.45;margin-top:.5em;max-width:86ch}figcaption b{color:var(--ink)}
.pair{display:grid;grid-template-columns:1fr 1fr;gap:0 40px}.pair figure{margin:1em 0 1.4em}
svg{display:block;width:100%;height:auto;overflow:visible}.narrow{display:none}
.legend{display:flex;flex-wrap:wrap;gap:3px 20px;font-size:.86rem;color:var(--soft);margin:.2em 0 .3em 44px}.legend span{white-space:nowrap}
.key{display:inline-block;width:26px;height:12px;margin-right:7px;vertical-align:-1px}
svg text{font-family:inherit}.tick{fill:var(--soft);font-size:12px}.label{fill:var(--soft);font-size:12.5px}.title{fill:var(--ink);font-size:12.5px;font-weight:600}
.mark{fill:var(--soft);font-size:11.5px}.rowlabel{fill:var(--ink);font-size:11.5px;paint-order:stroke;stroke:var(--paper);stroke-width:3px;stroke-linejoin:round}
.grid{stroke:var(--rule);stroke-width:1;fill:none}.zero,.axis{stroke:var(--soft);stroke-width:1;fill:none}
.line{fill:none;stroke:currentColor;stroke-linejoin:round}.area{fill:currentColor;opacity:.2}.dots{fill:none;stroke:currentColor;stroke-linecap:round}
rect.fault,rect.soft,rect.observer,rect.condensed{fill:currentColor}
.ink{color:var(--ink)}.muted{color:var(--soft)}.paper{color:var(--paper)}.fault{color:var(--fault)}.observer{color:var(--observer)}.condensed{color:var(--condensed)}
.a{color:var(--a)}.b{color:var(--b)}.c{color:var(--c)}.d{color:var(--d)}.ramp{color:color-mix(in oklab,var(--ramp-b) var(--m),var(--ramp-a))}
.h0{fill:var(--h0)}.h1{fill:var(--h1)}.h2{fill:var(--h2)}.h3{fill:var(--h3)}.h4{fill:var(--h4)}.h5{fill:var(--h5)}.h6{fill:var(--h6)}.h7{fill:var(--h7)}
.heat{display:flex;flex-wrap:wrap;gap:2px 0;font-size:.84rem;color:var(--soft);margin:.2em 0 .3em 44px}.heat span{display:inline-flex;align-items:center;margin-right:14px}
.heat svg{width:16px;height:12px;margin-right:6px;outline:1px solid var(--rule)}
@media screen and (max-width:900px){.pair{grid-template-columns:1fr}}
@media screen and (max-width:620px){.wide{display:none}.narrow{display:block}main{padding:22px 16px 60px}h1{font-size:1.5rem}.verdict{font-size:1.1rem}
.legend,.heat{margin-left:0}.tiles{grid-template-columns:1fr 1fr}.tile b{font-size:1.35rem}}
@page{margin:15mm 13mm}
@media print{body{font-size:10.5pt}main{max-width:none;padding:0}nav{display:none}a{color:inherit}h2{margin-top:1.8em}figure,.tiles,tr,.verdict{break-inside:avoid}
h2,h3{break-after:avoid}.scroll{overflow:visible}table{font-size:8pt}th{font-size:7.5pt}th,td{padding-left:9px}.hash{font-size:6.5pt}*{print-color-adjust:exact;-webkit-print-color-adjust:exact}}
)css";

}  // namespace

std::string_view page_style() {
  static const std::string style = std::string(colours) + std::string(text) + std::string(figures);
  return style;
}

}  // namespace spoolflow::report
