-- Version 8: the life of a revision, each step signed, and under which of them a run began.

ALTER TABLE revision ADD COLUMN state TEXT NOT NULL DEFAULT 'draft'
  CHECK (state IN ('draft', 'in_review', 'approved', 'released', 'withdrawn'));
ALTER TABLE revision ADD COLUMN released_us INTEGER;   -- NULL: never
ALTER TABLE revision ADD COLUMN withdrawn_us INTEGER;  -- NULL: not withdrawn
-- Who wrote a text, under whatever name: nobody approves his own.
CREATE INDEX revision_by_digest ON revision (sha256);

-- What was decided about revisions, in its order. Rows are never changed.
CREATE TABLE revision_step (
  id         INTEGER PRIMARY KEY,
  program    INTEGER NOT NULL,
  revision   INTEGER NOT NULL,
  name       TEXT NOT NULL,  -- of the program then; it may have been renamed since
  sha256     BLOB NOT NULL CHECK (length(sha256) = 32),  -- of the revision's bytes
  step       TEXT NOT NULL CHECK (step IN ('submit', 'approve', 'reject', 'release', 'withdraw')),
  time_us    INTEGER NOT NULL,
  who        TEXT NOT NULL,
  credential TEXT NOT NULL,
  address    TEXT NOT NULL,
  comment    TEXT NOT NULL,
  policy     BLOB NOT NULL CHECK (length(policy) = 32),     -- SHA-256 of the policy's text that was in force
  signature  BLOB NOT NULL CHECK (length(signature) = 64),  -- Ed25519, by the server (server/library/releases.hpp)
  FOREIGN KEY (program, revision) REFERENCES revision (program, number)
) STRICT;
CREATE INDEX revision_step_by_revision ON revision_step (program, revision, id);

-- Why the run was allowed: open (the policy asks for nothing), released, or prove_out (a draft, on such a machine).
ALTER TABLE run ADD COLUMN allowed_as TEXT NOT NULL DEFAULT 'open' CHECK (allowed_as IN ('open', 'released', 'prove_out'));
-- The release it ran under; NULL: none was needed.
ALTER TABLE run ADD COLUMN approval INTEGER REFERENCES revision_step (id);
