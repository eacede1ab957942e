#!/bin/sh
# ci/picture.sh REPORT.html LABEL: one figure of a report as a picture of its own, to standard output; LABEL is the beginning
# of the figure's aria-label, such as "Measured and estimated flow rate". For README.md and docs/.
set -eu
awk -v label="$2" '
BEGIN { RS = "\001" }
{
  style = substr($0, index($0, "<style>") + 7)
  style = substr(style, 1, index(style, "</style>") - 1)
  at = index($0, "aria-label=\"" label)
  if (!at) { print "no figure \"" label "\" in the report" > "/dev/stderr"; exit 1 }
  n = split(substr($0, 1, at), figures, "<figure[^>]*>")
  keys = split(figures[n], legend, "<svg class=\"key\"[^>]*>")
  drawings = split(figures[n], head, "<svg viewBox=\"")
  split(head[drawings], box, "[ \"]")
  svg = substr($0, at)
  inside = substr(svg, index(svg, ">") + 1)
  inside = substr(inside, 1, index(inside, "</svg>") - 1)
  top = 28
  printf "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 -%d %s %d\" font-family=\"sans-serif\">\n", top, box[3], box[4] + top
  printf "<style>%s</style>\n<rect x=\"0\" y=\"-%d\" width=\"100%%\" height=\"100%%\" fill=\"var(--paper)\"/>\n", style, top
  x = 44
  for (k = 2; k <= keys; ++k) {
    name = substr(legend[k], index(legend[k], "</svg>") + 6)
    name = substr(name, 1, index(name, "<") - 1)
    printf "<g transform=\"translate(%d,-18)\">%s</g>", x, substr(legend[k], 1, index(legend[k], "</svg>") - 1)
    printf "<text class=\"label\" x=\"%d\" y=\"-8\">%s</text>\n", x + 33, name
    x += 54 + 7 * length(name)
  }
  printf "%s\n</svg>\n", inside
}' "$1"
