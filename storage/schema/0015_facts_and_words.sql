-- Version 15: what an attestation of a run names besides: the setup file of its gateway, and the revisions that its program called.

-- SHA-256 (hexadecimal) of the gateway's own setup file, as it reports it at the start; NULL: it has none, or did not say so.
ALTER TABLE run ADD COLUMN gateway_setup TEXT;

-- Each called program that the run's gateway got text of. Part of the run's digest in the audit trail, as the columns of `run` are.
CREATE TABLE run_call (
  run      INTEGER NOT NULL REFERENCES run (number),
  name     TEXT NOT NULL,     -- as the program calls it
  program  INTEGER NOT NULL REFERENCES program (id),
  revision INTEGER NOT NULL,
  sha256   BLOB NOT NULL CHECK (length(sha256) = 32),
  PRIMARY KEY (run, name)
) STRICT, WITHOUT ROWID;
