#!/usr/bin/env bash
# Scans `#include "..."` lines against the table of allowed arrows between folders. Prints every arrow that is not allowed.
set -euo pipefail
cd "$(dirname "$0")/../.."

# folder (longest prefix wins): folders it may include
table='
protocol/base: protocol/base
protocol/pki: protocol/base protocol/pki
protocol/audit: protocol/base protocol/audit
protocol/archive: protocol/base protocol/archive
protocol/measurement: protocol/base protocol/measurement
protocol/wire: protocol/base protocol/wire
protocol/process: protocol/base protocol/process
protocol/serial: protocol/base protocol/wire protocol/serial
protocol/dds: protocol/base protocol/pki protocol/dds
storage/sql: protocol/base storage/sql
storage/sqlite: protocol/base storage/sql storage/sqlite
storage/postgresql: protocol/base storage/sql storage/postgresql
storage/backup: protocol/base storage
storage/cache: protocol/base storage
storage/migration: protocol/base storage
storage: protocol/base protocol/audit protocol/measurement storage
gateway/interpreter/core: protocol/base gateway/interpreter/core
gateway/interpreter/stages: protocol/base gateway/interpreter/core gateway/interpreter/stages
gateway/interpreter/dialects/centurion: protocol/base gateway/interpreter/core gateway/interpreter/stages gateway/interpreter/dialects/centurion
gateway/interpreter/dialects/fanuc: protocol/base gateway/interpreter/core gateway/interpreter/stages gateway/interpreter/dialects/fanuc
gateway/interpreter/dialects/prototrak: protocol/base gateway/interpreter/core gateway/interpreter/stages gateway/interpreter/dialects/prototrak
gateway/interpreter/dialects/rs274ngc: protocol/base gateway/interpreter/core gateway/interpreter/stages gateway/interpreter/dialects/rs274ngc
gateway/interpreter/dialects/tektronix1704: protocol/base gateway/interpreter/core gateway/interpreter/stages gateway/interpreter/dialects/tektronix1704
gateway/interpreter/dialects/tnc155: protocol/base gateway/interpreter/core gateway/interpreter/stages gateway/interpreter/dialects/tnc155
gateway/interpreter: protocol/base gateway/interpreter
clients/tools/program_editing: protocol/base gateway/interpreter clients/tools/program_editing clients/tools/tnc_conversion
clients/tools/tnc_conversion: protocol/base gateway/interpreter clients/tools/tnc_conversion
clients/tools/statistics: protocol/base clients/tools/statistics
clients/tools/authority: protocol/base protocol/pki clients/tools/authority
clients/tools/tnc_probing: protocol/base gateway/interpreter clients/tools/tnc_probing
gateway/machine: protocol/base gateway/interpreter gateway/machine
gateway/machine/grbl: protocol/base protocol/wire protocol/serial gateway/interpreter gateway/machine
gateway/feed: protocol gateway/interpreter gateway/machine gateway/feed storage/sql storage/sqlite
gateway/line: protocol/base protocol/measurement protocol/wire protocol/process protocol/serial gateway/interpreter gateway/line
gateway/report: protocol gateway/interpreter gateway/machine gateway/report storage/sql storage/sqlite
gateway/app: protocol gateway storage/sql storage/sqlite
server/library: protocol/base protocol/archive protocol/measurement protocol/pki protocol/audit protocol/process storage gateway/interpreter server/library
server/identity: protocol/base protocol/process storage server/library server/identity
server/machines: protocol storage gateway/interpreter server/library server/machines
server/ports: protocol storage gateway/interpreter gateway/line server/library server/machines server/ports
server/paths: protocol/base storage gateway/interpreter clients/tools/comparison clients/tools/offline server/library server/machines server/paths
server/imports: protocol/base protocol/process storage server/library server/paths server/imports
server/measurements: protocol/base protocol/measurement protocol/process storage clients/tools/report_template server/measurements
server/offsets: protocol/base protocol/measurement protocol/process storage gateway/interpreter clients/tools/statistics server/library server/offsets
server/api: protocol storage gateway/interpreter gateway/line clients/tools/charts clients/tools/measurement_files clients/tools/report_template clients/tools/studies server/library server/machines server/ports server/identity server/paths server/imports server/measurements server/offsets server/folders server/webhooks server/mqtt server/api
server/folders: protocol/base protocol/process storage server/library server/machines server/paths server/folders
server/webhooks: protocol/base protocol/pki protocol/process storage server/webhooks
server/mqtt: protocol/base protocol/pki protocol/process storage server/machines server/mqtt
server/mtconnect: protocol storage gateway/interpreter server/library server/machines server/api server/mtconnect
server/web: protocol/base server/api server/web
server/app: protocol storage server
clients/lib: protocol/base protocol/pki clients/lib
clients/tools: protocol/base protocol/measurement protocol/wire gateway/interpreter clients/tools
clients/tools/report_template: protocol/base protocol/measurement clients/tools/report_template
clients/cli: protocol/base protocol/archive protocol/pki protocol/audit protocol/measurement protocol/wire protocol/serial gateway/interpreter clients
'
declare -A allowed_by
while IFS=: read -r row folders; do
  [[ -n $row ]] && allowed_by[$row]=$folders
done <<<"$table"

folder_of() {  # sets `folder` to the longest row that $1 lies under
  folder=""
  for row in "${!allowed_by[@]}"; do
    if [[ $1 == "$row"/* && ${#row} -gt ${#folder} ]]; then folder=$row; fi
  done
}

bad=0 checked=0
while IFS=: read -r file line include; do
  target=${include#*\"}; target=${target%%\"*}
  [[ $file == "${last_file-}" ]] || folder_of "$file"
  last_file=$file
  checked=$((checked + 1))
  if [[ -z $folder ]]; then echo "$file:$line: no row for this folder in the table"; bad=1; continue; fi
  ok=no
  for row in ${allowed_by[$folder]}; do [[ $target == "$row"/* ]] && ok=yes; done
  owner=${target%%/impl/*}
  if [[ $target == */impl/* && $file != "$owner"/* ]]; then ok=impl; fi
  [[ $target == *dripline.h ]] && ok=yes  # generated from the IDL, inside protocol/dds
  case $ok in
    no) echo "$file:$line: $folder must not include $target"; bad=1 ;;
    impl) echo "$file:$line: $target is private to its folder"; bad=1 ;;
  esac
done < <(git ls-files protocol storage gateway server clients | grep -E '\.(hpp|cpp)$' | xargs grep -nE '^#include "' /dev/null)

# Third-party headers that only one folder may see.
only() {  # pattern, folder (or several: a|b)
  if git ls-files protocol storage gateway server clients | grep -E '\.(hpp|cpp)$' | grep -vE "^($2)/" | xargs grep -nE "^#include <($1)" /dev/null; then
    echo "only $2 may include these"; bad=1
  fi
}
only 'dds/' protocol/dds
only 'cairo' clients/tools/chart_images
only 'SQLiteCpp|sqlite3' storage/sqlite
only 'libpq-fe' storage/postgresql
only 'boost/(asio|beast|system)' server/api
only 'boost/math' clients/tools/statistics
only 'httplib' 'clients/lib|server/webhooks'  # the server is a client where it delivers events
only 'sodium' server/identity
only 'mosquitto|mqtt_protocol' none  # brokers are read by server/mqtt itself; tests subscribe with it
only 'libxml/' server/mtconnect

echo "$checked includes checked"
exit $bad
