#!/usr/bin/env bash
# Installs the build folder into a temporary prefix; then the programs run from there with the examples that came with them.
# install_test.sh BUILD
set -euo pipefail
cd "$(dirname "$0")/../../.."
build=$1
prefix=$(mktemp -d)
trap 'rm -rf "$prefix"' EXIT
cmake --install "$build" --prefix "$prefix" >"$prefix/log" || { cat "$prefix/log"; exit 1; }

version=$(sed -n 's/^project(dripline VERSION \([0-9.]*\).*/\1/p' CMakeLists.txt)
for program in dncd dncgw dnc; do
  printed=$("$prefix/bin/$program" --version)
  [[ $printed == *"$version"* ]] || { echo "$program prints '$printed' instead of $version"; exit 1; }
done
test -x "$prefix/bin/null_modem"

doc=$prefix/share/doc/dripline
"$prefix/bin/dnc" check --setup "$doc/examples/lathe-1.toml" "$doc/examples/digitize.nc"
cmp server/api/openapi.json "$prefix/share/dripline/openapi.json"
diff -r deploy/examples "$doc/examples"
diff -r deploy/macros "$prefix/share/dripline/macros"
for page in deploy/docs/*.md; do cmp "$page" "$doc/docs/${page##*/}"; done
for page in README.md CHANGELOG.md docs/rest-api.md; do test -s "$doc/$page"; done
