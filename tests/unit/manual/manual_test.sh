#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# shellcheck disable=SC2317  # the functions are called by check()
# Checks that what code and manual point to is there: manual_test.sh SOURCE_DIR
set -euo pipefail
cd "$1"
failures=0

check() {  # TITLE FUNCTION, which prints one offender per line
  local offenders
  offenders=$("$2")
  if [[ -z $offenders ]]; then
    echo "ok      $1"
  else
    echo "FAILED  $1:"
    printf '%s\n' "$offenders"
    failures=$((failures + 1))
  fi
}

sources() { grep -r "$@" src apps tests cmake tools benchmarks cases docs ./*.md --exclude-dir=build || true; }

broken_links() {
  local page link
  while read -r page; do
    { grep -oE '[^=]\]\([^) ]+\)' "$page" || true; } | sed -E 's/^.\]\(//; s/\)$//; s/#.*//' | while read -r link; do
      [[ -z $link || $link == *://* || -e $(dirname "$page")/$link ]] || echo "  $page: $link"
    done
  done < <(find ./*.md docs cases validation benchmarks -name '*.md')
}

missing_pages() {
  local file
  sources -hoE '\b(docs|cases|validation|benchmarks|tools)/[A-Za-z0-9_/-]+\.(md|bib|txt|py|toml)' | sort -u |
    while read -r file; do [[ -e $file ]] || echo "  $file"; done
}

listed_keys() { sed -nE 's/^@[a-z]+\{([^,]+),.*/\1/p' docs/references.bib | sort; }
repeated_keys() { listed_keys | uniq -d; }
unknown_keys() {
  sources -hoE '\b[a-z]+_(1[89]|20)[0-9]{2}_[a-z]+' --include='*.[ch]pp' --include='*.md' | sort -u |
    comm -23 - <(listed_keys | uniq)
}

unlicensed_files() {
  sources -LE '^(//|#) SPDX-License-Identifier: BSD-3-Clause' --include='*.[ch]pp' --include='*.sh' --include='*.py'
}

check "every link of the manual leads to a file" broken_links
check "every page and case that code or manual names exists" missing_pages
check "every source that is cited is in references.bib" unknown_keys
check "no source is listed twice" repeated_keys
check "every source file names its licence" unlicensed_files
exit $((failures > 0))
