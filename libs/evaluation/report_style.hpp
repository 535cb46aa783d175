#pragma once
// The report's looks: one style sheet for page and figures. Blue is the fused pose, orange dead
// reckoning, green the camera, grey the truth, everywhere; they differ in width and dashes too, so
// that they can be told apart in print and by the colour-blind.
#include <string_view>

namespace vpdr::evaluation {

/// Colours and figure classes: enough for an SVG file of its own.
inline constexpr std::string_view kFigureStyle = R"css(
:root{--page:#f4f5f6;--card:#ffffff;--ink:#1b1f23;--muted:#5c6670;--line:#e3e6e9;--grid:#eceef0;
--truth:#8d97a1;--fused:#1f5fd0;--pdr:#d9730d;--vision:#0a8f72;--halo:#1f5fd010;--veil:#ffffffcc}
@media (prefers-color-scheme:dark){:root{--page:#121416;--card:#1a1d20;--ink:#e8ebee;
--muted:#9aa4ae;--line:#2e3338;--grid:#262a2e;--truth:#87919b;--fused:#6ba5ff;--pdr:#f0a04b;
--vision:#43c8a4;--halo:#6ba5ff1c;--veil:#1a1d20cc}}
@media print{:root{--page:#fff;--card:#fff;--ink:#000;--muted:#444;--line:#ccc;--grid:#e8e8e8;
--truth:#8d97a1;--fused:#1f5fd0;--pdr:#d9730d;--vision:#0a8f72;--halo:#1f5fd010;--veil:#ffffffcc}}
svg{font-family:system-ui,-apple-system,"Segoe UI",Roboto,"DejaVu Sans",sans-serif}
svg text{fill:var(--muted);font-size:12px;font-variant-numeric:tabular-nums}
svg text.legend{fill:var(--ink);font-size:12.5px}
svg .page{fill:var(--card)}
svg .grid{stroke:var(--grid);stroke-width:1}
svg .zero{stroke:var(--muted);stroke-width:1;opacity:.55}
svg .frame{fill:none;stroke:var(--line);stroke-width:1}
svg .bar{stroke:var(--ink);stroke-width:1.5}
svg .veil{fill:var(--veil)}
svg .truth{fill:none;stroke:var(--truth);stroke-width:4;stroke-linejoin:round;stroke-linecap:round}
svg .truth.thin{stroke-width:2}
svg .fused{fill:none;stroke:var(--fused);stroke-width:2;stroke-linejoin:round}
svg .fused.thin{stroke-width:1;opacity:.6}
svg .pdr{fill:none;stroke:var(--pdr);stroke-width:1.6;stroke-dasharray:6 3;stroke-linejoin:round}
svg .fused-dot{fill:var(--fused)}
svg .pdr-dot{fill:var(--pdr)}
svg .vision{fill:var(--vision)}
svg .ellipse{fill:var(--halo);stroke:var(--fused);stroke-width:1;stroke-opacity:.5}
svg .waypoint{fill:var(--card);stroke:var(--ink);stroke-width:1.8}
svg .whisker{stroke:var(--ink);stroke-width:1;opacity:.55}
svg .start{fill:var(--card);stroke:var(--fused);stroke-width:2.5}
svg .end{fill:var(--fused);stroke:var(--card);stroke-width:1.5}
svg .hover{fill:transparent;stroke:none}
svg .hover:hover{fill:var(--fused)}
svg .bin{fill:var(--fused);opacity:.85}
svg .bin:hover{opacity:1}
svg .marker{stroke:var(--ink);stroke-width:1;stroke-dasharray:3 3}
)css";

/// The page around the figures.
inline constexpr std::string_view kPageStyle = R"css(
*{box-sizing:border-box}
body{margin:0;background:var(--page);color:var(--ink);line-height:1.5;
font:15px/1.5 system-ui,-apple-system,"Segoe UI",Roboto,"DejaVu Sans",sans-serif}
main{max-width:1120px;margin:0 auto;padding:36px 20px 60px}
header p{color:var(--muted);margin:4px 0 0}
h1{font-size:26px;line-height:1.25;margin:0;font-weight:650;overflow-wrap:anywhere}
h2{font-size:17px;margin:0 0 2px;font-weight:650}
section{background:var(--card);border:1px solid var(--line);border-radius:10px;
padding:20px 20px 14px;margin-top:18px;break-inside:avoid}
section>p{color:var(--muted);margin:0 0 12px;max-width:85ch}
section svg{display:block;width:100%;height:auto}
.figures{display:grid;grid-template-columns:repeat(auto-fit,minmax(235px,1fr));gap:14px;
margin-top:22px}
.figure{background:var(--card);border:1px solid var(--line);border-radius:10px;padding:14px 16px}
.figure .name{color:var(--muted);font-size:13px}
.figure .value{font-size:28px;line-height:1.2;font-weight:650;font-variant-numeric:tabular-nums}
.figure .value small{font-size:16px;font-weight:500;color:var(--muted);margin-left:3px}
.figure .more{color:var(--muted);font-size:13px}
.scroll{overflow-x:auto}
table{border-collapse:collapse;width:100%;font-size:14px;margin-bottom:8px}
th,td{padding:6px 12px 6px 0;text-align:left;border-bottom:1px solid var(--line);
vertical-align:top}
th{color:var(--muted);font-weight:500}
td.n,th.n{text-align:right;font-variant-numeric:tabular-nums;white-space:nowrap}
tr:last-child td{border-bottom:0}
details{margin:6px 0}
summary{cursor:pointer;color:var(--muted)}
pre{overflow-x:auto;background:var(--page);border-radius:6px;padding:12px;font-size:12.5px}
ul{margin:0 0 8px;padding-left:20px}
li{overflow-wrap:anywhere}
footer{color:var(--muted);font-size:13px;margin-top:24px}
@media (max-width:640px){main{padding:20px 10px 40px}section{padding:14px 10px 8px}
section svg{min-width:720px}}
@media print{main{padding:0;max-width:none}section,.figure{border-color:#ccc}
details{display:none}}
)css";

}  // namespace vpdr::evaluation
