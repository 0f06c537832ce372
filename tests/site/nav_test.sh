#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# The site's nav names files that are, and every page of the project; what a page links to is there. Usage: nav_test.sh ESTAMPE_FOLDER
set -euo pipefail
cd "$1"
failures=0
named="$(grep -oE '[A-Za-z0-9_/.-]+\.md$' docs/mkdocs.yml | sort)"
pages="$(find README.md SECURITY.md app docs examples src worlds -name '*.md' | sort)"
only_named="$(comm -23 <(echo "$named") <(echo "$pages"))"
only_there="$(comm -13 <(echo "$named") <(echo "$pages"))"
[[ -z "$only_named" ]] || { echo "FAILED: docs/mkdocs.yml names what is not there: $only_named" >&2; failures=1; }
[[ -z "$only_there" ]] || { echo "FAILED: docs/mkdocs.yml leaves out $only_there" >&2; failures=1; }
for decision in docs/decisions/0*.md; do
    grep -qF "($(basename "$decision"))" docs/decisions/README.md || { echo "FAILED: docs/decisions/README.md leaves out $decision" >&2; failures=1; }
done
# links FILE: what it links to, from the root of the project
links() {
    { grep -oE '\]\([^)# ]+' "$1" | cut -c 3- | grep -v '://' || true; } | while read -r link; do
        realpath --canonicalize-missing --relative-to=. "$(dirname "$1")/$link"
    done
}
while read -r page; do
    while read -r target; do
        [[ -f $target || -f $target/README.md ]] || { echo "FAILED: $page links to $target, which is no file" >&2; failures=1; }
    done < <(links "$page")
done <<<"$pages"
exit "$failures"
