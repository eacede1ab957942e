#!/bin/sh
# ci/man_page.sh COMMAND: prints the manual page, made from the command's own help.
set -eu
spoolflow=$1
version=$("$spoolflow" --version | cut -d' ' -f2)

# One help page as roff: headings become bold words, arguments and options become paragraphs with a tag.
roff_of() {
  "$spoolflow" "$@" --help | awk '
    function text(line) { gsub(/…/, "...", line); gsub(/\\/, "\\e", line); gsub(/-/, "\\-", line); sub(/^[.\047]/, "\\\\\\&&", line); return line }
    function words(line) { sub(/^ +/, "", line); print text(line) }
    NR == 1 { print ".PP"; print text($0); next }
    /^Usage: / { print ".PP"; print ".B " text(substr($0, 8)); next }
    /^(Arguments|Options|Commands|Examples):$/ { list = $1; sub(":", "", list); print ".PP"; print ".B " list; next }
    /^(Reads|Writes): / { list = ""; print ".TP"; print ".B " $1; sub(/^[A-Za-z]+: */, ""); words($0); next }
    /^$/ { next }
    list == "Examples" { print ".br"; print ".RS"; print ".nf"; words($0); print ".fi"; print ".RE"; next }
    list != "" && /^  [^ ]/ {
      print ".TP"
      tag = $0; rest = ""
      if (length(tag) > 26 && substr(tag, 26, 1) == " ") { rest = substr(tag, 27); tag = substr(tag, 1, 26) }
      gsub(/^ +| +$/, "", tag)
      print ".B " text(tag)
      if (rest != "") words(rest)
      next
    }
    { words($0) }'
}

cat <<END
.\\" Made by ci/man_page.sh from the help of the command.
.TH SPOOLFLOW 1 "" "spoolflow $version" "User Commands"
.SH NAME
spoolflow \\- soft flow\\-rate sensor for solenoid\\-operated spool valves
.SH SYNOPSIS
.B spoolflow
.I COMMAND
.RI [ ARGUMENTS ]\\ [ OPTIONS ]
.SH DESCRIPTION
END
roff_of
echo '.SH COMMANDS'
for command in $("$spoolflow" --help | sed -n '/^Commands/,/^$/s/^  \([a-z]\{1,\}\) .*/\1/p'); do
  echo ".SS spoolflow $command"
  roff_of "$command"
done
cat <<'END'
.SH EXIT STATUS
.TP
.B 0
done
.TP
.B 1
the work failed
.TP
.B 2
wrong usage or unusable input
END
