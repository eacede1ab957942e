#!/bin/sh
# c_examples.sh SPOOLFLOW MODEL LIBRARY C_EXAMPLE PYTHON_EXAMPLE SCENARIO: both examples of the C interface say of a recording
# what `spoolflow estimate` says of it. They print six decimals of L/min; units convert in other roundings.
set -eu
spoolflow=$1 model=$2 library=$3 c_example=$4 python_example=$5 scenario=$6
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
"$spoolflow" simulate -q "$scenario" -o run.csv
"$spoolflow" estimate -q "$model" run.csv -o expected.csv
"$c_example" "$model" <run.csv >c.csv
SPOOLFLOW_LIBRARY=$library /usr/bin/python3 "$python_example" "$model" <run.csv >python.csv

for said in c.csv python.csv; do
  paste -d, expected.csv "$said" | awk -F, -v said="$said" '
    NR == 1 { if ($1 $2 $3 $4 $9 != $10 $11 $12 $13 $14) { print said ": other columns"; exit 1 } next }
    { for (k = 1; k <= 4; ++k) { d = $k - $(k + 9); if (d < 0) d = -d; if (d > largest) largest = d }
      if ($9 != $14) ++other }
    END { print said ": " NR - 1 " rows, largest difference " largest + 0 " L/min, " other + 0 " other status"
          exit !(NR > 1000 && largest <= 2e-6 && other == 0) }'
done

# Without a model both say why and end as a program does that cannot.
! "$c_example" missing.json </dev/null 2>message && grep -q 'missing.json' message
! SPOOLFLOW_LIBRARY=$library /usr/bin/python3 "$python_example" missing.json </dev/null 2>message && grep -q 'missing.json' message
