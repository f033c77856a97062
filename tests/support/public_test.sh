#!/bin/bash
# tests/public counts programs by how they end.
set -eu
dnc=$1
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
mkdir "$folder/programs"
printf '0 BEGIN PGM RUNS MM\n1 L X+1 R0 FMAX\n2 END PGM RUNS MM\n' > "$folder/programs/runs.h"
printf '0 BEGIN PGM TOOL MM\n1 TOOL CALL 7 Z S100\n2 END PGM TOOL MM\n' > "$folder/programs/tool.h"
printf '0 BEGIN PGM WORD MM\n1 L X+1 R0 F100 O5\n2 END PGM WORD MM\n' > "$folder/programs/word.h"

public() {
  status=0
  "$(dirname "$0")/../public" itnc "$folder/programs" --dnc "$dnc" "$@" > "$folder/out" || status=$?
}
expect() { grep -qF -- "$1" "$folder/out" || { echo "missing: $1"; cat "$folder/out"; exit 1; }; }

public
[ "$status" = 1 ]
expect '3 programs: 1 run to their end, 2 do not; with the alarms of --expect 33 % are correct'
expect '     1 TNC-TOOL-DEF-MISSING'
expect 'word.h: line 2: NOT SUPPORTED: O5'

public --expect TNC-TOOL-DEF-MISSING TNC-NOT-SUPPORTED
[ "$status" = 0 ]
expect '100 % are correct'

public --like 'runs*'
[ "$status" = 0 ]
expect '1 programs: 1 run to their end'
