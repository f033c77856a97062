#!/usr/bin/env bash
# cluster.sh FOLDER PROCESS: a PostgreSQL of the tests' own, unprivileged, listening on a socket in FOLDER alone; user and database
# dripline, no password. It ends with PROCESS (parent: whoever started this). Where it runs already nothing is done. DRIPLINE_FSYNC=on: as in a shop, for figures.
# Exit code 77: PostgreSQL is not installed.
set -euo pipefail
folder=$1 process=$2
if [[ $process == parent ]]; then process=$PPID; fi

bin=$(ls -d /usr/lib/postgresql/*/bin 2>/dev/null | sort -V | tail -1)
if [[ -z $bin || ! -x $bin/initdb ]]; then
  echo "PostgreSQL is not installed (Debian: postgresql)"
  exit 77
fi
as=()
if [[ $(id -u) == 0 ]]; then  # PostgreSQL refuses to be root
  as=(setpriv --reuid=postgres --regid=postgres --clear-groups)
fi
if [[ -S $folder/.s.PGSQL.5432 ]] && "${as[@]}" "$bin/pg_ctl" -D "$folder/data" status >/dev/null 2>&1; then
  exit 0
fi
rm -rf "$folder"
mkdir -p "$folder"
# In memory where there is room, and no figures are asked for: a database is made for each test.
fsync=${DRIPLINE_FSYNC:-off} memory=
if [[ $fsync == off ]] && (($(df --output=avail -k /dev/shm 2>/dev/null | tail -1 || echo 0) > 2 << 20)); then
  memory=/dev/shm/$(basename "$folder")
  rm -rf "$memory"
  mkdir "$memory"
  ln -s "$memory" "$folder/data"
  if [[ $(id -u) == 0 ]]; then chown postgres: "$memory"; fi
fi
chmod 755 "$folder"
if [[ $(id -u) == 0 ]]; then chown postgres: "$folder"; fi
cd "$folder"
"${as[@]}" "$bin/initdb" -D "$folder/data" -A trust -U dripline --no-locale -E UTF8 --no-sync >"$folder/initdb.log" 2>&1
"${as[@]}" "$bin/pg_ctl" -D "$folder/data" -w -l "$folder/server.log" start >"$folder/start.log" 2>&1 \
  -o "-k $folder -c listen_addresses='' -c fsync=$fsync -c full_page_writes=$fsync -c max_connections=200 \
      -c shared_buffers=64MB -c max_wal_size=512MB -c wal_level=minimal -c max_wal_senders=0 -c autovacuum=off"
"$bin/psql" -h "$folder" -U dripline -d postgres -qc 'CREATE DATABASE dripline' 2>>"$folder/start.log"

(
  exec </dev/null >/dev/null 2>&1
  while kill -0 "$process" 2>/dev/null; do sleep 1; done
  "${as[@]}" "$bin/pg_ctl" -D "$folder/data" -m immediate stop
  rm -rf "$folder" ${memory:+"$memory"}
) &
disown
