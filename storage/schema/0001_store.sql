-- Version 1 of what the server keeps.
-- Times end in _us: UTC microseconds since 1970. Sizes and offsets are bytes. Names are the words of storage/store.hpp.

-- Program bytes ---------------------------------------------------------------------------------

-- A piece of content, kept once however many contents hold it. Deleted when no content holds it.
CREATE TABLE chunk (
  id     INTEGER PRIMARY KEY,
  sha256 BLOB NOT NULL UNIQUE CHECK (length(sha256) = 32),  -- of the plain bytes
  size   INTEGER NOT NULL CHECK (size BETWEEN 1 AND 262144),  -- of the plain bytes
  data   BLOB NOT NULL                                        -- one zstd frame
) STRICT;

-- An ordered list of chunks. Without a digest while an upload fills it; immutable afterwards.
CREATE TABLE content (
  id     INTEGER PRIMARY KEY,
  sha256 BLOB UNIQUE CHECK (length(sha256) = 32),  -- of all bytes
  size   INTEGER NOT NULL CHECK (size >= 0)
) STRICT;

-- Every chunk but the last has 262144 bytes, so the chunk of an offset is found by division.
CREATE TABLE content_chunk (
  content  INTEGER NOT NULL REFERENCES content (id),
  position INTEGER NOT NULL CHECK (position >= 0),  -- 0, 1, 2 ...
  chunk    INTEGER NOT NULL REFERENCES chunk (id),
  PRIMARY KEY (content, position)
) STRICT, WITHOUT ROWID;
CREATE INDEX content_chunk_by_chunk ON content_chunk (chunk);

-- Programs --------------------------------------------------------------------------------------

CREATE TABLE program (
  id              INTEGER PRIMARY KEY,
  name            TEXT NOT NULL UNIQUE,
  removed_through INTEGER NOT NULL DEFAULT 0  -- revisions up to this number are hidden; runs still have them
) STRICT;

CREATE TABLE revision (
  program    INTEGER NOT NULL REFERENCES program (id),
  number     INTEGER NOT NULL CHECK (number >= 1),  -- 1, 2, 3 ... per program, never used twice
  content    INTEGER NOT NULL REFERENCES content (id),
  control    TEXT NOT NULL,  -- dialect name, or empty when not known
  comment    TEXT NOT NULL,
  author     TEXT NOT NULL,
  created_us INTEGER NOT NULL,
  PRIMARY KEY (program, number)
) STRICT, WITHOUT ROWID;

-- Content that is still arriving; becomes a revision or is dropped.
CREATE TABLE upload (
  id         TEXT PRIMARY KEY,
  program    TEXT NOT NULL,  -- its name; the program comes to be with its first revision
  control    TEXT NOT NULL,
  comment    TEXT NOT NULL,
  author     TEXT NOT NULL,
  content    INTEGER NOT NULL UNIQUE REFERENCES content (id),  -- its size is what was received
  created_us INTEGER NOT NULL,
  touched_us INTEGER NOT NULL  -- when the last piece came
) STRICT, WITHOUT ROWID;

-- Machines and runs -----------------------------------------------------------------------------

CREATE TABLE machine (
  id              INTEGER PRIMARY KEY,
  name            TEXT NOT NULL UNIQUE,
  control         TEXT NOT NULL,
  description     TEXT NOT NULL,
  gateway_version TEXT NOT NULL,
  epoch           INTEGER NOT NULL,  -- of its records: the gateway's journal it numbers them in
  first_seen_us   INTEGER NOT NULL,
  last_seen_us    INTEGER NOT NULL
) STRICT;

CREATE TABLE run (
  number           INTEGER PRIMARY KEY,  -- order of creation
  id               TEXT NOT NULL UNIQUE,
  machine          INTEGER NOT NULL REFERENCES machine (id),
  program          INTEGER NOT NULL,
  revision         INTEGER NOT NULL,
  control          TEXT NOT NULL,  -- the dialect it runs as
  state            TEXT NOT NULL CHECK (state IN
    ('ordered', 'active', 'completed', 'aborted', 'alarmed', 'interrupted', 'refused')),
  sent             INTEGER NOT NULL,  -- bytes delivered to the gateway
  accepted         INTEGER NOT NULL,  -- blocks interpreted
  executed         INTEGER NOT NULL,  -- blocks finished by the machine
  line             INTEGER NOT NULL,  -- of the block executed last
  sequence         INTEGER NOT NULL,  -- its N number; -1: none
  reason           TEXT NOT NULL,     -- why it ended, for people
  executed_content TEXT,              -- SHA-256 (hexadecimal) the gateway reports of the bytes it received
  content_verified INTEGER CHECK (content_verified IN (0, 1)),  -- those are the revision's bytes
  author           TEXT NOT NULL,
  created_us       INTEGER NOT NULL,
  started_us       INTEGER,
  ended_us         INTEGER,
  outputs          INTEGER NOT NULL DEFAULT 0,  -- stored records of kind output
  FOREIGN KEY (program, revision) REFERENCES revision (program, number)
) STRICT;
-- One unfinished run per machine.
CREATE UNIQUE INDEX run_unfinished ON run (machine) WHERE state IN ('ordered', 'active');
CREATE INDEX run_by_machine ON run (machine);
CREATE INDEX run_by_program ON run (program, revision);

-- Records ---------------------------------------------------------------------------------------

-- What machines reported, identified for ever by (machine, epoch, number).
CREATE TABLE record (
  machine  INTEGER NOT NULL REFERENCES machine (id),
  epoch    INTEGER NOT NULL,
  number   INTEGER NOT NULL CHECK (number >= 1),
  time_us  INTEGER NOT NULL,  -- at the gateway
  run      TEXT,              -- its id; NULL: outside any run. Not a reference: a gateway may know more than we do
  kind     TEXT NOT NULL,     -- the wire's name
  block    INTEGER NOT NULL,  -- ordinal of the executed block
  line     INTEGER NOT NULL,
  sequence INTEGER NOT NULL,  -- N number; -1: none
  device   TEXT NOT NULL,     -- of an output: file, port1 ...
  text     TEXT NOT NULL,
  PRIMARY KEY (machine, epoch, number)
) STRICT, WITHOUT ROWID;
CREATE INDEX record_by_run ON record (run, epoch, number) WHERE run IS NOT NULL;

-- Up to where the records of each journal are stored without a gap: what is acknowledged.
CREATE TABLE record_epoch (
  machine INTEGER NOT NULL REFERENCES machine (id),
  epoch   INTEGER NOT NULL,
  last    INTEGER NOT NULL,
  PRIMARY KEY (machine, epoch)
) STRICT, WITHOUT ROWID;

-- Audit -----------------------------------------------------------------------------------------

CREATE TABLE audit (
  id      INTEGER PRIMARY KEY,
  time_us INTEGER NOT NULL,
  who     TEXT NOT NULL,
  action  TEXT NOT NULL,
  subject TEXT NOT NULL,
  detail  TEXT NOT NULL
) STRICT;
