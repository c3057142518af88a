#!/usr/bin/env bash
# Puts what ClusterFuzz wants into $OUT: of each target the binary, its options, and its seeds,
# corpus and regressions as one archive; and the dictionaries. Runs in the workspace.
set -euo pipefail

# Coverage is asked for as if it were a sanitizer; the image's flags see to it.
[[ ${SANITIZER:-} != coverage ]] || SANITIZER=none
export SANITIZER=${SANITIZER:-address}
bin=$(fuzz/build)

cp fuzz/dictionaries/*.dict fuzz/options/*.options "$OUT"
for options in fuzz/options/*.options; do
    target=$(basename "$options" .options)
    cp "$bin/$target" "$OUT"
    mapfile -t folders < <(fuzz/inputs "$target")
    mapfile -t inputs < <(find "${folders[@]/#/fuzz/}" -type f)
    rm -f "$OUT/${target}_seed_corpus.zip"
    python3 -m zipfile -c "$OUT/${target}_seed_corpus.zip" "${inputs[@]}"
done
