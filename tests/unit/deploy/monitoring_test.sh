#!/usr/bin/env bash
# What Prometheus itself says of the alert rules. Skipped (77) without promtool, of Debian's package prometheus.
set -euo pipefail
cd "$(dirname "$0")/../../../deploy/monitoring"
command -v promtool >/dev/null || { echo "promtool is not installed"; exit 77; }
promtool check rules alerts.yml
promtool test rules alerts_test.yml
