#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# shellcheck disable=SC2016,SC2317  # conditions are passed to check(); snippets are expanded by the launcher
# Tests of ./luff on a copy of it, with stand-ins for dpkg-query, apt-get and the build: launcher_test.sh SOURCE_DIR
set -euo pipefail

readonly source_dir=$1
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
readonly root=$scratch/clone
mkdir -p "$root/tools" "$root/build" "$scratch/bin" "$scratch/elsewhere"
cp "$source_dir/luff" "$root/luff"
printf '# heading\nalpha  # first\nbeta-dev\n' >"$root/tools/packages.txt"
failures=0

check() {  # TITLE CONDITION...
  if "${@:2}"; then
    echo "ok      $1"
  else
    echo "FAILED  $1: ${*:2}"
    failures=$((failures + 1))
  fi
}

contains() { [[ $1 == *"$2"* ]]; }

command_stub() {  # NAME SCRIPT
  printf '#!/bin/bash\n%s\n' "$2" >"$scratch/bin/$1"
  chmod +x "$scratch/bin/$1"
}

# Runs one function of the launcher after the given preparation, as the launcher would; prints messages and status.
launcher() {
  PATH=$scratch/bin:$PATH bash -c "set -e; source '$root/luff'; $1" 2>&1 && echo "status 0" || echo "status $?"
}

ln -s "$root/luff" "$scratch/elsewhere/link"
help=$(cd "$scratch/elsewhere" && ./link)
check "help is printed through a symbolic link from another folder" contains "$help" "luff run CASE"
check "help builds nothing" test ! -e "$root/build/release"

command_stub apt-get "echo \"\$@\" >>'$scratch/apt.log'; [[ \$* != *update* ]] || exit 0"
command_stub dpkg-query 'echo installed alpha; echo installed beta-dev'
out=$(launcher ensure_packages)
check "nothing is said when no package is missing" test "$out" = "status 0"
check "nothing is installed when no package is missing" test ! -e "$scratch/apt.log"

command_stub dpkg-query 'echo installed alpha; echo not-installed beta-dev; exit 1'
out=$(launcher 'root_command() { :; }; ensure_packages')
check "installing succeeds" contains "$out" "status 0"
apt=$(cat "$scratch/apt.log")
check "the list of packages is updated first" contains "$(head -n 1 "$scratch/apt.log")" "update"
check "the missing package is installed, without recommendations" \
  contains "$apt" "install -y --no-install-recommends beta-dev"
check "installed packages are left alone" test "$apt" = "${apt/alpha/}"

rm "$scratch/apt.log"
out=$(launcher 'root_command() { return 1; }; ensure_packages')
check "without root, the one command to run is printed" contains "$out" "apt-get install -y --no-install-recommends beta-dev"
check "without root, the launcher stops" contains "$out" "status 1"
check "without root, nothing is installed" test ! -e "$scratch/apt.log"

command_stub apt-get 'echo E: no such package; exit 100'
out=$(launcher 'root_command() { :; }; ensure_packages')
check "when installing fails, the end of apt's log is shown" contains "$out" "E: no such package"
check "when installing fails, the launcher stops" contains "$out" "status 1"

command_stub cmake 'echo no such preset; exit 1'
out=$(launcher ensure_configured)
check "when configuring fails, the end of CMake's log is shown" contains "$out" "no such preset"
check "when configuring fails, the launcher stops" contains "$out" "status 1"

command_stub cmake "printf '[1/2] Building CXX object a.o\nFAILED: b.o\nb.cpp:1: error\n'; exit 1"
out=$(launcher 'build_targets all')
check "when building fails, the compiler's message is shown" contains "$out" "b.cpp:1: error"
check "when building fails, the launcher stops" contains "$out" "status 1"
command_stub cmake "echo 'ninja: no work to do.'"
check "nothing is said when nothing is stale" test "$(launcher 'build_targets all')" = "status 0"

alone='ensure_packages() { :; }; ensure_configured() { :; }
       build_targets() { echo in >>"$LUFF_ROOT/build/order"; sleep 0.1; echo out >>"$LUFF_ROOT/build/order"; }; prepare all'
for _ in 1 2 3; do launcher "$alone" >"$scratch/started" & done
wait
check "instances that start at once build one after the other" \
  test "$(tr '\n' ' ' <"$root/build/order")" = "in out in out in out "

for script in luff .ci/run tools/format tools/lint; do
  check "$script is valid bash" bash -n "$source_dir/$script"
done
exit $((failures > 0))
