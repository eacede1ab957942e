#!/bin/sh
# ci/completion.sh COMMAND: prints the completion for bash, made from the command's own help.
set -eu
spoolflow=$1
options_of() {
  "$spoolflow" "$@" --help | sed -n '/^Options:/,/^$/s/^  \(-[^ ]*\).*/\1/p' | tr ',\n' '  ' | sed 's/ *$//'
}
commands=$("$spoolflow" --help | sed -n '/^Commands/,/^$/s/^  \([a-z]\{1,\}\) .*/\1/p' | tr '\n' ' ' | sed 's/ $//')

cat <<END
# Made by ci/completion.sh from the help of the command.
_spoolflow() {
  local current=\${COMP_WORDS[COMP_CWORD]} previous=\${COMP_WORDS[COMP_CWORD - 1]} words=
  if [ "\$COMP_CWORD" = 1 ]; then
    COMPREPLY=(\$(compgen -W "$commands $(options_of)" -- "\$current"))
    return
  fi
  case "\${COMP_WORDS[1]} \$previous" in
END
for command in $commands; do
  # Options with a choice, such as "--estimator TEXT:{condensed,observer}".
  "$spoolflow" "$command" --help | sed -n 's/^  \(-[^ ]*\) [A-Z]*:{\([^}]*\)}.*/\1 \2/p' | while read -r names choices; do
    for name in $(echo "$names" | tr , ' '); do
      echo "    \"$command $name\") COMPREPLY=(\$(compgen -W \"$(echo "$choices" | tr , ' ')\" -- \"\$current\")); return ;;"
    done
  done
  # A first argument with a choice: "KIND  fmu: …; cpp: …".
  choices=$("$spoolflow" "$command" --help | sed -n 's/^  KIND *//p' | tr ';' '\n' | sed -n 's/^ *\([a-z]\{1,\}\):.*/\1/p' | tr '\n' ' ')
  if [ -n "$choices" ]; then
    echo "    \"$command $command\") COMPREPLY=(\$(compgen -W \"${choices% }\" -- \"\$current\")); return ;;"
  fi
done
echo '  esac'
echo '  case ${COMP_WORDS[1]} in'
for command in $commands; do
  echo "    $command) words=\"$(options_of "$command")\" ;;"
done
cat <<'END'
  esac
  if [[ $current == -* ]]; then
    COMPREPLY=($(compgen -W "$words" -- "$current"))
  else
    compopt -o filenames 2>/dev/null
    COMPREPLY=($(compgen -f -- "$current"))
  fi
}
complete -F _spoolflow spoolflow
END
