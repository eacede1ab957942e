#!/bin/sh
# ci/cli_page.sh COMMAND [--check]: writes docs/cli.md from the built command's own help, or reports that it is out of date.
set -eu
spoolflow=$1
page=$(dirname "$0")/../docs/cli.md
made=$(mktemp)
trap 'rm -f "$made"' EXIT

help_of() {
  printf '\n## %s\n\n```\n' "$1"
  shift
  "$spoolflow" "$@" --help | grep -v -e '^  -h,--help ' -e '^  -q,--quiet '
  printf '```\n'
}
{
  echo "# The command"
  echo
  echo "Made by \`ci/cli_page.sh\` from \`spoolflow --help\`; a test keeps it fresh. Every command has \`--help\`; \`-q\` leaves out its"
  echo "progress, which is shown on a terminal only. Commands of add-ons are those of [live](live.md) and [fleet](fleet.md)."
  help_of spoolflow
  for command in $("$spoolflow" --help | sed -n '/^Commands:/,/^$/s/^  \([a-z]\{1,\}\) .*/\1/p'); do
    help_of "spoolflow $command" "$command"
  done
} >"$made"

if [ "${2:-}" = --check ]; then
  diff -u "$page" "$made" || {
    echo "docs/cli.md is out of date; run: ci/cli_page.sh $spoolflow" >&2
    exit 1
  }
else
  cat "$made" >"$page"
fi
