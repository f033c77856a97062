-- Version 15: what an attestation of a run names besides: the setup file of its gateway, and the revisions that its program called. And
-- the words of the full-text index, for what begins with some letters.

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

-- Words of letters alone, of three at least, that some document has or had: `rou*` is looked for as these words.
CREATE TABLE search_word (word TEXT NOT NULL PRIMARY KEY) STRICT, WITHOUT ROWID;
-- Comments have all their words now (storage/programs/search_words.hpp): everything is read again.
INSERT INTO search_index (search_index) VALUES ('delete-all');
DELETE FROM search_document;
INSERT INTO search_due (program) SELECT id FROM program WHERE true ON CONFLICT (program) DO UPDATE SET version = version + 1;
