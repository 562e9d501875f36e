# Sourced by the scripts of the project: root folder, environment, messages.
# Messages go to standard error, so that standard output is the program's.
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)

set -a
# shellcheck source=environment
. "$root/scripts/lib/environment"
set +a

say()
{
  printf '%s\n' "$*" >&2
}

fail()
{
  say "Error: $*"
  exit 1
}
