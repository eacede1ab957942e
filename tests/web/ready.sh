# Sourced by the tests that need the page's packages; $page is where they are.
if [ -e "$page/missing" ]; then
  echo "SKIPPED: $(cat "$page/missing")"
  exit 77
fi
