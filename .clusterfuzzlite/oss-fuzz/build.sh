#!/usr/bin/env bash
# The repository knows how.
set -euo pipefail
exec .clusterfuzzlite/build.sh
