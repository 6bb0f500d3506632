#!/usr/bin/env bash
# Builds the book in docs/ with mdbook and follows every link of its pages: bash tests/documentation/book.sh [MDBOOK].
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
mdbook=${1:-mdbook}
if ! command -v "$mdbook" >/dev/null; then
    echo "there is no $mdbook; \`cargo install mdbook\` puts one on the path" >&2
    exit 2
fi
book=$(mktemp -d)
trap 'rm -rf "$book"' EXIT
"$mdbook" build docs --dest-dir "$book"
# the whole workspace: with one package alone the libraries have other features and are built anew
BAGNOLD_BOOK="$book" cargo test --test suite -- --ignored --exact documentation::every_link_of_the_built_book_leads_somewhere
