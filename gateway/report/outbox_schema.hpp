#pragma once

#include <array>

#include "storage/sqlite/transaction.hpp"

namespace dripline::report {

/// A published step is never changed: a change of the schema is a new step at the end.
inline constexpr std::array kOutboxMigrations{storage::sqlite::Migration{1, "outbox", R"sql(
CREATE TABLE outbox (
  only_row    INTEGER PRIMARY KEY CHECK (only_row = 1),
  epoch       INTEGER NOT NULL, -- of the record numbers; random, not 0
  last_number INTEGER NOT NULL  -- given to a record
) STRICT;
CREATE TABLE record (
  number   INTEGER PRIMARY KEY,
  time_us  INTEGER NOT NULL, -- UTC
  run      TEXT NOT NULL,    -- empty: of no run
  kind     INTEGER NOT NULL, -- RecordKind of the wire
  block    INTEGER NOT NULL,
  line     INTEGER NOT NULL,
  sequence INTEGER NOT NULL, -- N number, -1 none
  device   TEXT NOT NULL,
  text     TEXT NOT NULL
) STRICT;
CREATE TABLE active_run (
  only_row INTEGER PRIMARY KEY CHECK (only_row = 1),
  run      TEXT NOT NULL,
  program  TEXT NOT NULL,
  revision TEXT NOT NULL,    -- SHA-256
  control  TEXT NOT NULL,
  size     INTEGER NOT NULL, -- bytes
  sent     INTEGER NOT NULL, -- bytes
  accepted INTEGER NOT NULL, -- blocks
  executed INTEGER NOT NULL, -- blocks
  line     INTEGER NOT NULL, -- of the block executed last
  sequence INTEGER NOT NULL, -- its N number, -1 none
  offset   INTEGER NOT NULL  -- bytes
) STRICT;
CREATE TABLE order_result (
  position    INTEGER PRIMARY KEY AUTOINCREMENT, -- the oldest are dropped
  id          TEXT NOT NULL UNIQUE,
  is_accepted INTEGER NOT NULL,
  reason      TEXT NOT NULL
) STRICT;
)sql"},
                                              storage::sqlite::Migration{2, "memory", R"sql(
-- What the control keeps when a program is over, as far as programs have changed it.
CREATE TABLE memory (
  name     TEXT PRIMARY KEY,  -- the control's own: P10, #500, G54.X
  value    TEXT,              -- decimal, as many digits as it takes; NULL: vacant
  base     TEXT,              -- what the setup gave it when the value came to be; NULL: vacant
  is_named INTEGER NOT NULL   -- 1: it gave it as a variable
) STRICT;
)sql"},
                                              storage::sqlite::Migration{3, "memory_seal", R"sql(
-- The same as it was when the last run began at its program's first block: what a start in the
-- middle of that program begins with.
CREATE TABLE memory_beginning (
  name     TEXT PRIMARY KEY,
  value    TEXT,
  base     TEXT,
  is_named INTEGER NOT NULL
) STRICT;
CREATE TABLE memory_state (
  only_row INTEGER PRIMARY KEY CHECK (only_row = 1),
  revision TEXT NOT NULL, -- SHA-256 of the program of memory_beginning; empty: none
  digest   TEXT NOT NULL, -- SHA-256 of both tables and this row; empty: written by a version before 3
  fault    TEXT NOT NULL  -- why the memory is not to be used; empty: it is sound
) STRICT;
INSERT INTO memory_state VALUES (1, '', '', '');
)sql"},
                                              storage::sqlite::Migration{4, "commands", R"sql(
ALTER TABLE order_result RENAME TO command_result;
)sql"},
                                              storage::sqlite::Migration{5, "checkpoints", R"sql(
-- What a restart in the middle of a run begins with; the bytes are sealed by their writer.
CREATE TABLE checkpoint_run (
  position   INTEGER PRIMARY KEY AUTOINCREMENT, -- the oldest are dropped
  run        TEXT NOT NULL UNIQUE,
  program    TEXT NOT NULL,
  revision   TEXT NOT NULL,    -- SHA-256
  control    TEXT NOT NULL,
  size       INTEGER NOT NULL, -- bytes
  conditions BLOB NOT NULL,    -- what it is interpreted under
  ending     BLOB NOT NULL     -- how far it came; empty: it has not ended
) STRICT;
CREATE TABLE checkpoint (
  run      TEXT NOT NULL REFERENCES checkpoint_run (run) ON DELETE CASCADE,
  block    INTEGER NOT NULL, -- interpreted
  executed INTEGER NOT NULL, -- blocks, at that time
  time_us  INTEGER NOT NULL, -- UTC
  bytes    BLOB NOT NULL,
  PRIMARY KEY (run, block)
) STRICT;
CREATE TABLE checkpoint_answer (
  run    TEXT NOT NULL REFERENCES checkpoint_run (run) ON DELETE CASCADE,
  number INTEGER NOT NULL, -- 1, 2, 3 ... of the run
  bytes  BLOB NOT NULL,
  PRIMARY KEY (run, number)
) STRICT;
ALTER TABLE active_run ADD COLUMN path INTEGER NOT NULL DEFAULT 0; -- hash of what was executed
)sql"}};

}  // namespace dripline::report
