#!/usr/bin/env bash
# cluster_control.sh FOLDER stop|start|freeze|thaw: what may happen to a server that cluster.sh has started. stop: at once, as of a failing machine; freeze: it
# keeps its sockets open and answers nothing.
set -euo pipefail
folder=$1 what=$2
bin=$(ls -d /usr/lib/postgresql/*/bin | sort -V | tail -1)
as=()
if [[ $(id -u) == 0 ]]; then as=(setpriv --reuid=postgres --regid=postgres --clear-groups); fi
cd "$folder"
signal() {  # the processes of this server, each a child of the first
  local first
  first=$(head -1 "$folder/data/postmaster.pid")
  kill "-$1" "$first"
  pgrep -P "$first" | xargs -r kill "-$1" 2>/dev/null || true
}
case $what in
  stop) "${as[@]}" "$bin/pg_ctl" -D "$folder/data" -m immediate -w stop >>"$folder/start.log" ;;
  start)
    "${as[@]}" "$bin/pg_ctl" -D "$folder/data" -w -l "$folder/server.log" start >>"$folder/start.log" 2>&1 \
      -o "-k $folder -c listen_addresses='' -c fsync=off -c max_connections=200" ;;
  freeze) signal STOP ;;
  thaw) signal CONT ;;
  *) exit 2 ;;
esac
