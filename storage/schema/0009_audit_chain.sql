-- Version 9: audit entries and the ends of runs are one hash chain, and the server signs where it is (protocol/audit).

-- SHA-256 of the chain up to this entry; the entries of versions before 9 get theirs in the same migration (impl/audit_repository.cpp).
ALTER TABLE audit ADD COLUMN chain BLOB CHECK (length(chain) = 32);
-- The end of a run has one entry (action run.end, its subject is the run), which holds a digest of the run's row.
CREATE INDEX audit_run_end ON audit (subject) WHERE action = 'run.end';

CREATE TABLE audit_checkpoint (
  number    INTEGER PRIMARY KEY,  -- 1, 2, 3 ...
  entry     INTEGER NOT NULL,     -- of audit: the chain up to it is signed
  time_us   INTEGER NOT NULL,
  chain     BLOB NOT NULL CHECK (length(chain) = 32),  -- of that entry
  signature BLOB NOT NULL CHECK (length(signature) = 64)  -- Ed25519, by the server
) STRICT;
