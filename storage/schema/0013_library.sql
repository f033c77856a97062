-- Version 13: what programs are for, files beside them, full-text search, and releases that pin what a program calls.

-- What a program is for: the same for all its revisions. Empty: not stated.
ALTER TABLE program ADD COLUMN part TEXT NOT NULL DEFAULT '';
ALTER TABLE program ADD COLUMN operation TEXT NOT NULL DEFAULT '';
ALTER TABLE program ADD COLUMN material TEXT NOT NULL DEFAULT '';
ALTER TABLE program ADD COLUMN machine_group TEXT NOT NULL DEFAULT '';  -- not a reference: it may have been removed since
-- Where the bytes of a revision come from; empty: not stated.
ALTER TABLE revision ADD COLUMN cam_file TEXT NOT NULL DEFAULT '';
-- Of an upload: what its revision gets; NULL: not stated, so the program keeps what it has.
ALTER TABLE upload ADD COLUMN part TEXT;
ALTER TABLE upload ADD COLUMN operation TEXT;
ALTER TABLE upload ADD COLUMN material TEXT;
ALTER TABLE upload ADD COLUMN machine_group TEXT;
ALTER TABLE upload ADD COLUMN cam_file TEXT;
-- It becomes an attachment of this name, of this revision or (NULL) of the program; NULL: a revision.
ALTER TABLE upload ADD COLUMN attachment TEXT;
ALTER TABLE upload ADD COLUMN attachment_revision INTEGER;

-- What listings show and choose by, so that none reads all revisions. Kept by the triggers below, whatever changes a revision.
ALTER TABLE program ADD COLUMN latest INTEGER;     -- in force with the highest number, or without one the newest held; NULL: not listed
ALTER TABLE program ADD COLUMN revisions INTEGER NOT NULL DEFAULT 0;  -- that can be seen
ALTER TABLE program ADD COLUMN held INTEGER NOT NULL DEFAULT 0;       -- of those: wait for acceptance
ALTER TABLE program ADD COLUMN released INTEGER;   -- the latest that is released; NULL: none
ALTER TABLE program ADD COLUMN latest_control TEXT;
ALTER TABLE program ADD COLUMN latest_author TEXT;
ALTER TABLE program ADD COLUMN latest_state TEXT;

CREATE INDEX program_listed ON program (name) WHERE latest IS NOT NULL;
CREATE INDEX program_by_part ON program (part, name) WHERE latest IS NOT NULL;
CREATE INDEX program_by_operation ON program (operation, name) WHERE latest IS NOT NULL;
CREATE INDEX program_by_material ON program (material, name) WHERE latest IS NOT NULL;
CREATE INDEX program_by_group ON program (machine_group, name) WHERE latest IS NOT NULL;
CREATE INDEX program_by_control ON program (latest_control, name) WHERE latest IS NOT NULL;
CREATE INDEX program_by_author ON program (latest_author, name) WHERE latest IS NOT NULL;
CREATE INDEX program_by_state ON program (latest_state, name) WHERE latest IS NOT NULL;

-- Attachments -----------------------------------------------------------------------------------

-- Setup sheets, drawings ...: bytes kept as those of programs are.
CREATE TABLE attachment (
  id         INTEGER PRIMARY KEY,
  program    INTEGER NOT NULL REFERENCES program (id),
  revision   INTEGER,        -- NULL: it belongs to the program, whatever its revision
  name       TEXT NOT NULL,  -- a file name without a folder
  content    INTEGER NOT NULL REFERENCES content (id),
  sha256     BLOB NOT NULL CHECK (length(sha256) = 32),
  comment    TEXT NOT NULL,
  author     TEXT NOT NULL,
  created_us INTEGER NOT NULL,
  FOREIGN KEY (program, revision) REFERENCES revision (program, number)
) STRICT;
-- What is dropped is looked for in every revision.
CREATE INDEX revision_by_content ON revision (content);
CREATE UNIQUE INDEX attachment_by_name ON attachment (program, coalesce(revision, 0), name);
CREATE INDEX attachment_by_digest ON attachment (sha256);
CREATE INDEX attachment_by_content ON attachment (content);

-- Releases with what they call ------------------------------------------------------------------

-- Of a release: how many revisions it pins, which are all that its program may call; NULL: it pins none, and a run
-- takes the newest it may.
ALTER TABLE revision_step ADD COLUMN closure INTEGER CHECK (closure IS NULL OR step = 'release');
-- Part of what is signed of the step. Rows are never changed.
CREATE TABLE revision_pin (
  step     INTEGER NOT NULL REFERENCES revision_step (id),
  position INTEGER NOT NULL CHECK (position >= 0),  -- 0, 1, 2 ... as they are signed
  program  INTEGER NOT NULL,
  revision INTEGER NOT NULL,
  name     TEXT NOT NULL,  -- of the program then: under which it is called
  sha256   BLOB NOT NULL CHECK (length(sha256) = 32),
  PRIMARY KEY (step, position),
  FOREIGN KEY (program, revision) REFERENCES revision (program, number)
) STRICT, WITHOUT ROWID;
CREATE INDEX revision_pin_by_revision ON revision_pin (program, revision);

-- Search ----------------------------------------------------------------------------------------

-- One document for each revision that can be seen: the words of its program and of its text (storage/programs/search_words.hpp). A later
-- version that makes words otherwise empties both tables and makes every program due.
CREATE TABLE search_document (
  id       INTEGER PRIMARY KEY AUTOINCREMENT,  -- its row in search_index; what changed last has the highest
  program  INTEGER NOT NULL,
  revision INTEGER NOT NULL,
  words    TEXT NOT NULL,     -- those that are not of the text: given again when the document is taken out
  text     INTEGER NOT NULL,  -- bytes of the text whose words it has
  UNIQUE (program, revision)
) STRICT;
-- No text is kept here: it is in the chunks. No positions either: words, not phrases.
CREATE VIRTUAL TABLE search_index USING fts5 (
  words, content = '', detail = none, columnsize = 0, tokenize = "ascii tokenchars '.-$'");
-- Programs whose documents are to be made again. A row goes in the transaction that made them; what was changed meanwhile
-- has another version by then, and stays.
CREATE TABLE search_due (
  program INTEGER PRIMARY KEY REFERENCES program (id),
  version INTEGER NOT NULL DEFAULT 1
) STRICT;

-- Triggers --------------------------------------------------------------------------------------

CREATE TRIGGER revision_added AFTER INSERT ON revision BEGIN
  UPDATE program SET (revisions, held, released, latest) = (
    SELECT count(*), coalesce(sum(standing = 'held'), 0), max(iif(state = 'released', number, NULL)),
           coalesce(max(iif(standing = 'accepted', number, NULL)), max(number))
    FROM revision WHERE revision.program = program.id AND number > removed_through AND standing <> 'rejected')
    WHERE id = NEW.program;
  UPDATE program SET (latest_control, latest_author, latest_state) = (
    SELECT control, author, state FROM revision WHERE revision.program = program.id AND number = latest)
    WHERE id = NEW.program;
  INSERT INTO search_due (program) VALUES (NEW.program) ON CONFLICT (program) DO UPDATE SET version = version + 1;
END;
CREATE TRIGGER revision_changed AFTER UPDATE OF standing, state, cam_file ON revision BEGIN
  UPDATE program SET (revisions, held, released, latest) = (
    SELECT count(*), coalesce(sum(standing = 'held'), 0), max(iif(state = 'released', number, NULL)),
           coalesce(max(iif(standing = 'accepted', number, NULL)), max(number))
    FROM revision WHERE revision.program = program.id AND number > removed_through AND standing <> 'rejected')
    WHERE id = NEW.program;
  UPDATE program SET (latest_control, latest_author, latest_state) = (
    SELECT control, author, state FROM revision WHERE revision.program = program.id AND number = latest)
    WHERE id = NEW.program;
  INSERT INTO search_due (program) VALUES (NEW.program) ON CONFLICT (program) DO UPDATE SET version = version + 1;
END;
CREATE TRIGGER program_removed AFTER UPDATE OF removed_through ON program BEGIN
  UPDATE program SET (revisions, held, released, latest) = (
    SELECT count(*), coalesce(sum(standing = 'held'), 0), max(iif(state = 'released', number, NULL)),
           coalesce(max(iif(standing = 'accepted', number, NULL)), max(number))
    FROM revision WHERE revision.program = program.id AND number > removed_through AND standing <> 'rejected')
    WHERE id = NEW.id;
  -- A program that is pushed again under the name begins without them.
  UPDATE program SET part = '', operation = '', material = '', machine_group = '' WHERE id = NEW.id;
  UPDATE OR IGNORE attachment SET revision = NEW.removed_through WHERE program = NEW.id AND revision IS NULL;
  DELETE FROM attachment WHERE program = NEW.id AND revision IS NULL;
  UPDATE program SET (latest_control, latest_author, latest_state) = (
    SELECT control, author, state FROM revision WHERE revision.program = program.id AND number = latest)
    WHERE id = NEW.id;
  INSERT INTO search_due (program) VALUES (NEW.id) ON CONFLICT (program) DO UPDATE SET version = version + 1;
END;
CREATE TRIGGER program_described AFTER UPDATE OF name, part, operation, material, machine_group ON program BEGIN
  INSERT INTO search_due (program) VALUES (NEW.id) ON CONFLICT (program) DO UPDATE SET version = version + 1;
END;
CREATE TRIGGER attachment_added AFTER INSERT ON attachment BEGIN
  INSERT INTO search_due (program) VALUES (NEW.program) ON CONFLICT (program) DO UPDATE SET version = version + 1;
END;
CREATE TRIGGER attachment_removed AFTER DELETE ON attachment BEGIN
  INSERT INTO search_due (program) VALUES (OLD.program) ON CONFLICT (program) DO UPDATE SET version = version + 1;
END;

-- What is here already: listed at once, indexed in the background.
UPDATE program SET (revisions, held, released, latest) = (
  SELECT count(*), coalesce(sum(standing = 'held'), 0), max(iif(state = 'released', number, NULL)),
         coalesce(max(iif(standing = 'accepted', number, NULL)), max(number))
  FROM revision WHERE revision.program = program.id AND number > removed_through AND standing <> 'rejected');
UPDATE program SET (latest_control, latest_author, latest_state) = (
  SELECT control, author, state FROM revision WHERE revision.program = program.id AND number = latest);
INSERT INTO search_due (program) SELECT id FROM program WHERE true ON CONFLICT (program) DO NOTHING;
