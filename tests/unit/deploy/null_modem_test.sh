#!/usr/bin/env bash
# A cable with a rate passes characters no faster than a line of it; with faults some of them are not what was sent.
# null_modem_test.sh NULL_MODEM
set -euo pipefail
cable=$1
folder=$(mktemp -d)
child=
trap 'kill $child 2>/dev/null || true; rm -rf "$folder"' EXIT

# pass TEXT COUNT OPTIONS...: what comes out of the other end, the first COUNT characters.
pass() {
  local text=$1 count=$2
  shift 2
  "$cable" "$@" "$folder/host" "$folder/control" &
  child=$!
  until [[ -L $folder/host && -L $folder/control ]]; do kill -0 $child; sleep 0.01; done
  exec 3<>"$folder/host" 4<>"$folder/control"
  printf '%s' "$text" >&3
  timeout 60 head -c "$count" <&4 >"$folder/got"
  exec 3>&- 4>&-
  kill $child
  wait $child
  [[ ! -e $folder/host ]] || { echo "the links are still there"; exit 1; }
}

text=$(printf 'N%04d G1 X1.\n' {1..20})
before=$(date +%s%N)
pass "$text" ${#text} --rate 1200
elapsed=$((($(date +%s%N) - before) / 1000000))
[[ $(<"$folder/got") == "$text" ]] || { echo "other text came out"; exit 1; }
least=$((${#text} * 10 * 1000 / 1200 * 9 / 10))
((elapsed >= least)) || { echo "${#text} characters at 1200 baud took $elapsed ms"; exit 1; }

pass "$text" 200 --faults 10
[[ $(<"$folder/got") != "${text:0:200}" ]] || { echo "nothing was damaged"; exit 1; }
cp "$folder/got" "$folder/first"
pass "$text" 200 --faults 10
cmp "$folder/got" "$folder/first"

! "$cable" --rate fast "$folder/host" "$folder/control" 2>"$folder/usage"
grep -q 'usage: null_modem \[--rate BAUD\] \[--faults N\] HOST CONTROL' "$folder/usage"
