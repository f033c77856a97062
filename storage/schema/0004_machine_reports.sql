-- Version 4: what machines printed outside any run is found without reading all their records.

CREATE INDEX record_without_run ON record (machine, epoch, number) WHERE run IS NULL AND kind IN ('output', 'probe');
