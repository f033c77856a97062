-- Version 16: readers of the records, such as a broker that they are published to.

-- It reads what is stored after its row was made.
CREATE TABLE record_reader (
  name     TEXT PRIMARY KEY,
  since_us INTEGER NOT NULL
) STRICT, WITHOUT ROWID;

-- Up to which record of a journal a reader has all. Without a row: none.
CREATE TABLE record_cursor (
  reader  TEXT NOT NULL REFERENCES record_reader (name),
  machine INTEGER NOT NULL REFERENCES machine (id),
  epoch   INTEGER NOT NULL,
  number  INTEGER NOT NULL,
  PRIMARY KEY (reader, machine, epoch)
) STRICT, WITHOUT ROWID;
