#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# What tests in shell share: a folder that goes when they end, and wrong WORD..., which counts failures.
folder="$(mktemp -d)"
trap 'rm -rf "$folder"' EXIT
failures=0

wrong() {
    echo "FAILED: $*" >&2
    failures=$((failures + 1))
}
