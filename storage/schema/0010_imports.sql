-- Version 10: the import queue: what machines sent, what it changes, and what was decided about it.

-- One row for each revision that came from a machine.
CREATE TABLE import (
  program         INTEGER NOT NULL,
  revision        INTEGER NOT NULL,
  machine         TEXT NOT NULL,  -- that sent it
  state           TEXT NOT NULL DEFAULT 'pending' CHECK (state IN ('pending', 'accepted', 'accepted_as', 'rejected')),
  base            INTEGER,        -- the revision of the same program it was compared with; NULL: none
  class           TEXT NOT NULL DEFAULT '',  -- of the edit (clients/tools/comparison); empty: not known
  fault           TEXT NOT NULL DEFAULT '',  -- why the class is not known, or why it waits for a person
  compared_us     INTEGER,        -- NULL: not yet
  decided_us      INTEGER,        -- NULL: pending
  who             TEXT NOT NULL DEFAULT '',  -- decided
  reason          TEXT NOT NULL DEFAULT '',  -- as they gave it
  is_at_once      INTEGER NOT NULL DEFAULT 0 CHECK (is_at_once IN (0, 1)),  -- accepted by the policy, seen by nobody
  target          TEXT NOT NULL DEFAULT '',  -- accepted_as: the program that got it, by its name then
  target_revision INTEGER,
  PRIMARY KEY (program, revision),
  FOREIGN KEY (program, revision) REFERENCES revision (program, number)
) STRICT, WITHOUT ROWID;
CREATE INDEX import_pending ON import (program, revision) WHERE state = 'pending';
CREATE INDEX import_decided ON import (decided_us) WHERE state <> 'pending';

-- What waits already is left to a person.
INSERT INTO import (program, revision, machine, fault, compared_us)
  SELECT program, number, iif(author LIKE 'machine %', substr(author, 9), author), 'it came before the import queue', created_us
  FROM revision WHERE standing = 'held';
