-- A database of schema version 11 with a bit of everything, as the program of that version left it.
PRAGMA foreign_keys=OFF;
BEGIN TRANSACTION;
CREATE TABLE chunk (
  id     INTEGER PRIMARY KEY,
  sha256 BLOB NOT NULL UNIQUE CHECK (length(sha256) = 32),  -- of the plain bytes
  size   INTEGER NOT NULL CHECK (size BETWEEN 1 AND 262144),  -- of the plain bytes
  data   BLOB NOT NULL                                        -- one zstd frame
) STRICT;
INSERT INTO chunk VALUES(1,X'82fd126da9155a17a769ba10a60e7fa955e96af4fb37dca49e5dbe7d1468d450',12,X'28b52ffd200c6100004730302058312e0a4d33300a');
INSERT INTO chunk VALUES(2,X'3e260f07836b82fd7b65aac368f8d95d67bdf637f8b4aabe75fff65af29bb3f1',12,X'28b52ffd200c6100004730302058322e0a4d33300a');
INSERT INTO chunk VALUES(3,X'da2477a3c847cd3b0b5aa488874b00bd5e960e56eb059a5fb483fb70d2dc57e0',3,X'28b52ffd20031900004d320a');
INSERT INTO chunk VALUES(4,X'0a27cc5fb7f6b883d3e37bcf448557ee9de5c29b0d287b430b6711679db8238d',5,X'28b52ffd20052900004730312058');
CREATE TABLE content (
  id     INTEGER PRIMARY KEY,
  sha256 BLOB UNIQUE CHECK (length(sha256) = 32),  -- of all bytes
  size   INTEGER NOT NULL CHECK (size >= 0)
, seal BLOB CHECK (length(seal) = 32)) STRICT;
INSERT INTO content VALUES(1,X'82fd126da9155a17a769ba10a60e7fa955e96af4fb37dca49e5dbe7d1468d450',12,X'3b6ea2c697a313fb073b594cec24d2b81cc2b99a5928cd6170e594759432c686');
INSERT INTO content VALUES(2,X'3e260f07836b82fd7b65aac368f8d95d67bdf637f8b4aabe75fff65af29bb3f1',12,X'f512ce5eddecd367b7fb4fa1eff6003d54d600a8cfaa4d82e17920eaabd59f11');
INSERT INTO content VALUES(3,X'da2477a3c847cd3b0b5aa488874b00bd5e960e56eb059a5fb483fb70d2dc57e0',3,X'b6070dfadd1cf9f3a1adda6fec80d212dd9c28748ccabe0bbd133844ee4717b0');
INSERT INTO content VALUES(4,NULL,5,NULL);
CREATE TABLE content_chunk (
  content  INTEGER NOT NULL REFERENCES content (id),
  position INTEGER NOT NULL CHECK (position >= 0),  -- 0, 1, 2 ...
  chunk    INTEGER NOT NULL REFERENCES chunk (id), sha256 BLOB CHECK (length(sha256) = 32),
  PRIMARY KEY (content, position)
) STRICT, WITHOUT ROWID;
INSERT INTO content_chunk VALUES(1,0,1,X'82fd126da9155a17a769ba10a60e7fa955e96af4fb37dca49e5dbe7d1468d450');
INSERT INTO content_chunk VALUES(2,0,2,X'3e260f07836b82fd7b65aac368f8d95d67bdf637f8b4aabe75fff65af29bb3f1');
INSERT INTO content_chunk VALUES(3,0,3,X'da2477a3c847cd3b0b5aa488874b00bd5e960e56eb059a5fb483fb70d2dc57e0');
INSERT INTO content_chunk VALUES(4,0,4,X'0a27cc5fb7f6b883d3e37bcf448557ee9de5c29b0d287b430b6711679db8238d');
CREATE TABLE program (
  id              INTEGER PRIMARY KEY,
  name            TEXT NOT NULL UNIQUE,
  removed_through INTEGER NOT NULL DEFAULT 0  -- revisions up to this number are hidden; runs still have them
) STRICT;
INSERT INTO program VALUES(1,'p.nc',0);
INSERT INTO program VALUES(2,'gone.nc',1);
CREATE TABLE revision (
  program    INTEGER NOT NULL REFERENCES program (id),
  number     INTEGER NOT NULL CHECK (number >= 1),  -- 1, 2, 3 ... per program, never used twice
  content    INTEGER NOT NULL REFERENCES content (id),
  control    TEXT NOT NULL,  -- dialect name, or empty when not known
  comment    TEXT NOT NULL,
  author     TEXT NOT NULL,
  created_us INTEGER NOT NULL, standing TEXT NOT NULL DEFAULT 'accepted'
  CHECK (standing IN ('accepted', 'held', 'rejected')), accepted_us INTEGER, sha256 BLOB CHECK (length(sha256) = 32), state TEXT NOT NULL DEFAULT 'draft'
  CHECK (state IN ('draft', 'in_review', 'approved', 'released', 'withdrawn')), released_us INTEGER, withdrawn_us INTEGER,
  PRIMARY KEY (program, number)
) STRICT, WITHOUT ROWID;
INSERT INTO revision VALUES(1,1,1,'centurion','a comment','cam',1700000000000000,'accepted',NULL,X'82fd126da9155a17a769ba10a60e7fa955e96af4fb37dca49e5dbe7d1468d450','withdrawn',NULL,1700000000000011);
INSERT INTO revision VALUES(1,2,2,'centurion','a comment','cam',1700000000000000,'accepted',NULL,X'3e260f07836b82fd7b65aac368f8d95d67bdf637f8b4aabe75fff65af29bb3f1','draft',NULL,NULL);
INSERT INTO revision VALUES(1,3,3,'centurion','punched','machine m1',1700000000000000,'held',NULL,X'da2477a3c847cd3b0b5aa488874b00bd5e960e56eb059a5fb483fb70d2dc57e0','draft',NULL,NULL);
INSERT INTO revision VALUES(2,1,3,'centurion','a comment','cam',1700000000000000,'accepted',NULL,X'da2477a3c847cd3b0b5aa488874b00bd5e960e56eb059a5fb483fb70d2dc57e0','draft',NULL,NULL);
CREATE TABLE upload (
  id         TEXT PRIMARY KEY,
  program    TEXT NOT NULL,  -- its name; the program comes to be with its first revision
  control    TEXT NOT NULL,
  comment    TEXT NOT NULL,
  author     TEXT NOT NULL,
  content    INTEGER NOT NULL UNIQUE REFERENCES content (id),  -- its size is what was received
  created_us INTEGER NOT NULL,
  touched_us INTEGER NOT NULL  -- when the last piece came
, held INTEGER NOT NULL DEFAULT 0 CHECK (held IN (0, 1)), idle_seconds INTEGER NOT NULL DEFAULT 0) STRICT, WITHOUT ROWID;
INSERT INTO upload VALUES('u1','half.nc','','','cam',4,1700000000000000,1700000000000000,0,0);
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
INSERT INTO machine VALUES(1,'m1','centurion','','',7,1700000000000000,1700000000000000);
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
  outputs          INTEGER NOT NULL DEFAULT 0, setup INTEGER, sha256 BLOB CHECK (length(sha256) = 32), allowed_as TEXT NOT NULL DEFAULT 'open' CHECK (allowed_as IN ('open', 'released', 'prove_out')), approval INTEGER REFERENCES revision_step (id),  -- stored records of kind output
  FOREIGN KEY (program, revision) REFERENCES revision (program, number)
) STRICT;
INSERT INTO run VALUES(1,'r1',1,1,1,'centurion','completed',12,2,2,0,-1,'M30',NULL,1,'operator',1700000000000000,3,5,1,1,X'82fd126da9155a17a769ba10a60e7fa955e96af4fb37dca49e5dbe7d1468d450','open',NULL);
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
  text     TEXT NOT NULL, received_us INTEGER,
  PRIMARY KEY (machine, epoch, number)
) STRICT, WITHOUT ROWID;
INSERT INTO record VALUES(1,7,1,1000001,'r1','run_started',10,11,12,'port1','X1',1001501);
INSERT INTO record VALUES(1,7,2,1000002,'r1','output',20,22,24,'port1','X2',1001502);
INSERT INTO record VALUES(1,7,3,1000003,'r1','run_ended',30,33,36,'port1','X3',1001503);
CREATE TABLE record_epoch (
  machine INTEGER NOT NULL REFERENCES machine (id),
  epoch   INTEGER NOT NULL,
  last    INTEGER NOT NULL,
  PRIMARY KEY (machine, epoch)
) STRICT, WITHOUT ROWID;
INSERT INTO record_epoch VALUES(1,7,3);
CREATE TABLE audit (
  id      INTEGER PRIMARY KEY,
  time_us INTEGER NOT NULL,
  who     TEXT NOT NULL,
  action  TEXT NOT NULL,
  subject TEXT NOT NULL,
  detail  TEXT NOT NULL
, credential TEXT NOT NULL DEFAULT '', address TEXT NOT NULL DEFAULT '', chain BLOB CHECK (length(chain) = 32)) STRICT;
INSERT INTO audit VALUES(1,1700000000000000,'cam','push','p.nc','{}','','',X'741b05f7258199f09569020856a7528d48a197d887966cc43483818c41fa19fd');
INSERT INTO audit VALUES(2,5,'server','run.end','r1','completed on m1: p.nc revision 1, 2 blocks executed: M30; run sha256 54fca436968d995ef9f97f78cdc1015b0a6633106993fbaa24ae72cc0a404cbd','','',X'f2cba5ad89cbcaea8fcf887c502a3f6c684752ebff053f6d28c6805ea0d20438');
CREATE TABLE port (
  name          TEXT PRIMARY KEY,
  machine       TEXT NOT NULL,  -- at its end; not a reference: it may not have been seen yet
  address       TEXT NOT NULL UNIQUE,  -- one port writes to a line
  line_template TEXT NOT NULL,  -- or empty
  rules         TEXT NOT NULL,  -- what a text from the control means (TOML), or empty
  is_enabled    INTEGER NOT NULL CHECK (is_enabled IN (0, 1))
) STRICT, WITHOUT ROWID;
INSERT INTO port VALUES('line-1','m1','/dev/ttyUSB0','tnc155',replace('[[rule]]\n','\n',char(10)),1);
CREATE TABLE port_setting (
  port     TEXT NOT NULL REFERENCES port (name) ON DELETE CASCADE,
  position INTEGER NOT NULL CHECK (position >= 0),  -- 0, 1, 2 ... as they were given
  key      TEXT NOT NULL,
  value    TEXT NOT NULL,
  PRIMARY KEY (port, position),
  UNIQUE (port, key)
) STRICT, WITHOUT ROWID;
INSERT INTO port_setting VALUES('line-1',0,'baud','4800');
INSERT INTO port_setting VALUES('line-1',1,'flow','xonxoff');
CREATE TABLE setup (
  machine    TEXT NOT NULL,  -- not a reference: it may not have been seen yet
  number     INTEGER NOT NULL CHECK (number > 0),  -- 1, 2, 3 ... per machine
  text       TEXT NOT NULL,  -- TOML
  sha256     BLOB NOT NULL CHECK (length(sha256) = 32),
  comment    TEXT NOT NULL,
  author     TEXT NOT NULL,
  created_us INTEGER NOT NULL,
  PRIMARY KEY (machine, number)
) STRICT, WITHOUT ROWID;
INSERT INTO setup VALUES('m1',1,replace('[[tool]]\nnumber = 4\n','\n',char(10)),X'0416fea2bfc67a7cd21fc2db7de3ddab9c6552143817fea43dc7bc5d4cb516d9','first','admin',1000001);
INSERT INTO setup VALUES('m1',2,replace('[[tool]]\nnumber = 5\n','\n',char(10)),X'cad87e0771e182e3b37c43e74b9def6152200a4a6421e44c4f79144afdc53a60','second','admin',1000002);
CREATE TABLE identity (id TEXT PRIMARY KEY) STRICT, WITHOUT ROWID;
INSERT INTO identity VALUES('0123456789abcdef0123456789abcdef');
CREATE TABLE user (
  name         TEXT PRIMARY KEY,
  role         TEXT NOT NULL CHECK (role IN ('viewer', 'operator', 'programmer', 'approver', 'administrator')),
  password     TEXT NOT NULL,  -- argon2id digest with salt and cost, in its own text form; empty: no password
  state        TEXT NOT NULL CHECK (state IN ('active', 'locked', 'removed')),  -- a removed user's name is never used again
  created_us   INTEGER NOT NULL,
  signed_in_us INTEGER  -- last time with the password; NULL: never
) STRICT, WITHOUT ROWID;
INSERT INTO user VALUES('admin','administrator','','active',1700000000000000,NULL);
INSERT INTO user VALUES('anna','operator','$argon2id$v=19$m=8,t=1,p=1$YWJjZGVmZ2hpamtsbW5vcA$xSmTDI3YzgyM5XIcT1qPTbwgxqGvmMG6cTdiSkmAPws','locked',1700000000000001,1700000000000009);
INSERT INTO user VALUES('bert','viewer','','removed',1700000000000002,NULL);
CREATE TABLE machine_group (name TEXT PRIMARY KEY) STRICT, WITHOUT ROWID;
INSERT INTO machine_group VALUES('all');
INSERT INTO machine_group VALUES('lathes');
CREATE TABLE machine_group_member (
  machine_group TEXT NOT NULL REFERENCES machine_group (name) ON DELETE CASCADE,
  machine       TEXT NOT NULL,  -- not a reference: it may not have been seen yet
  PRIMARY KEY (machine_group, machine)
) STRICT, WITHOUT ROWID;
INSERT INTO machine_group_member VALUES('lathes','m1');
CREATE TABLE user_group (
  user          TEXT NOT NULL REFERENCES user (name),
  machine_group TEXT NOT NULL REFERENCES machine_group (name),
  PRIMARY KEY (user, machine_group)
) STRICT, WITHOUT ROWID;
INSERT INTO user_group VALUES('admin','all');
INSERT INTO user_group VALUES('anna','lathes');
CREATE TABLE credential (
  user       TEXT NOT NULL REFERENCES user (name),
  name       TEXT NOT NULL,  -- one per user
  kind       TEXT NOT NULL CHECK (kind IN ('token', 'login', 'page')),  -- page: in a cookie
  sha256     BLOB NOT NULL UNIQUE CHECK (length(sha256) = 32),  -- of the secret
  role       TEXT NOT NULL CHECK (role IN ('viewer', 'operator', 'programmer', 'approver', 'administrator')),  -- at most
  has_groups INTEGER NOT NULL CHECK (has_groups IN (0, 1)),  -- 1: those of credential_group at most; 0: its user's
  created_us INTEGER NOT NULL,
  expires_us INTEGER,  -- NULL: never
  used_us    INTEGER,  -- about a minute late; NULL: never
  used_from  TEXT NOT NULL,  -- the client's address then
  PRIMARY KEY (user, name)
) STRICT, WITHOUT ROWID;
INSERT INTO credential VALUES('admin','local','token',X'82fd126da9155a17a769ba10a60e7fa955e96af4fb37dca49e5dbe7d1468d450','administrator',0,1700000000000005,NULL,NULL,'');
INSERT INTO credential VALUES('anna','dashboard','token',X'da2477a3c847cd3b0b5aa488874b00bd5e960e56eb059a5fb483fb70d2dc57e0','viewer',1,1700000000000003,1800000000000000,1700000000000004,'192.0.2.7');
CREATE TABLE credential_group (
  user          TEXT NOT NULL,
  name          TEXT NOT NULL,
  machine_group TEXT NOT NULL REFERENCES machine_group (name),
  PRIMARY KEY (user, name, machine_group),
  FOREIGN KEY (user, name) REFERENCES credential (user, name) ON DELETE CASCADE
) STRICT, WITHOUT ROWID;
INSERT INTO credential_group VALUES('anna','dashboard','lathes');
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
INSERT INTO revision_step VALUES(1,1,1,'p.nc',X'82fd126da9155a17a769ba10a60e7fa955e96af4fb37dca49e5dbe7d1468d450','withdraw',1700000000000011,'anna','dashboard','192.0.2.7','scrap',X'0000000000000000000000000000000000000000000000000000000000000000',X'00000000000000000000000000000000000000000000000000000000000000000000000000000000000000000000000000000000000000000000000000000000');
CREATE TABLE audit_checkpoint (
  number    INTEGER PRIMARY KEY,  -- 1, 2, 3 ...
  entry     INTEGER NOT NULL,     -- of audit: the chain up to it is signed
  time_us   INTEGER NOT NULL,
  chain     BLOB NOT NULL CHECK (length(chain) = 32),  -- of that entry
  signature BLOB NOT NULL CHECK (length(signature) = 64)  -- Ed25519, by the server
) STRICT;
INSERT INTO audit_checkpoint VALUES(1,2,1700000000000009,X'f2cba5ad89cbcaea8fcf887c502a3f6c684752ebff053f6d28c6805ea0d20438',X'00000000000000000000000000000000000000000000000000000000000000000000000000000000000000000000000000000000000000000000000000000000');
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
INSERT INTO import VALUES(1,3,'m1','pending',2,'geometry','',1700000000000012,NULL,'','',0,'',NULL);
CREATE TABLE report_template (
  name       TEXT NOT NULL,
  version    INTEGER NOT NULL CHECK (version >= 1),
  text       TEXT NOT NULL,  -- TOML (clients/tools/report_template)
  author     TEXT NOT NULL,
  created_us INTEGER NOT NULL,
  is_removed INTEGER NOT NULL DEFAULT 0 CHECK (is_removed IN (0, 1)),
  PRIMARY KEY (name, version)
) STRICT, WITHOUT ROWID;
INSERT INTO report_template VALUES('bore',1,replace('[[line]]\nform = "X{actual}"\ncharacteristic = "X"\n','\n',char(10)),'anna',1700000000000013,0);
CREATE TABLE report_template_assignment (
  scope      TEXT NOT NULL CHECK (scope IN ('program', 'machine', 'macro')),
  subject    TEXT NOT NULL,  -- name of the program, the machine, or the printing macro
  template   TEXT NOT NULL,
  version    INTEGER,        -- NULL: the newest
  author     TEXT NOT NULL,
  created_us INTEGER NOT NULL,
  PRIMARY KEY (scope, subject, template)
) STRICT, WITHOUT ROWID;
INSERT INTO report_template_assignment VALUES('program','p.nc','bore',NULL,'anna',1700000000000014);
CREATE TABLE measurement_cursor (
  machine INTEGER NOT NULL REFERENCES machine (id),
  epoch   INTEGER NOT NULL,
  number  INTEGER NOT NULL,
  PRIMARY KEY (machine, epoch)
) STRICT, WITHOUT ROWID;
INSERT INTO measurement_cursor VALUES(1,7,3);
CREATE TABLE measurement_state (
  machine INTEGER PRIMARY KEY REFERENCES machine (id),
  state   TEXT NOT NULL  -- JSON (server/measurements)
) STRICT;
INSERT INTO measurement_state VALUES(1,'');
CREATE TABLE measured_part (
  id            INTEGER PRIMARY KEY,
  machine       INTEGER NOT NULL REFERENCES machine (id),
  run           TEXT,              -- its id; NULL: outside any run
  program       TEXT NOT NULL,     -- its name then; empty: not known
  revision      INTEGER NOT NULL,
  template      TEXT NOT NULL,
  version       INTEGER NOT NULL,  -- of the template
  number        TEXT NOT NULL,     -- of the part, as reported
  serial        TEXT NOT NULL,
  measurements  INTEGER NOT NULL,
  findings      INTEGER NOT NULL,
  verdict       INTEGER NOT NULL CHECK (verdict BETWEEN 0 AND 3),  -- good, unknown, rework, scrap: of all so far
  begun_us      INTEGER NOT NULL,
  ended_us      INTEGER,           -- NULL: lines may follow
  is_superseded INTEGER NOT NULL DEFAULT 0 CHECK (is_superseded IN (0, 1)),  -- derived again
  FOREIGN KEY (template, version) REFERENCES report_template (name, version)
) STRICT;
INSERT INTO measured_part VALUES(1,1,'r1','p.nc',1,'bore',1,'','S7',1,1,2,1700000000000003,1700000000000004,0);
CREATE TABLE measured_part_number (
  last INTEGER NOT NULL
) STRICT;
INSERT INTO measured_part_number VALUES(1);
CREATE TABLE characteristic_name (
  id   INTEGER PRIMARY KEY,
  name TEXT NOT NULL UNIQUE
) STRICT;
INSERT INTO characteristic_name VALUES(1,'X');
CREATE TABLE characteristic (
  id       INTEGER PRIMARY KEY,
  name     INTEGER NOT NULL REFERENCES characteristic_name (id),
  nominal  REAL,              -- in `unit`, like all values
  lower    REAL,              -- still good; NULL: not limited on that side
  upper    REAL,
  unit     TEXT NOT NULL,
  decimals INTEGER NOT NULL,  -- that the report has
  tool     TEXT NOT NULL      -- that cuts it; may be empty
) STRICT;
INSERT INTO characteristic VALUES(1,1,2.0,1.9899999999999999911,2.0099999999999997868,'mm',3,'T3');
CREATE TABLE measurement (
  id             INTEGER PRIMARY KEY,
  part           INTEGER NOT NULL REFERENCES measured_part (id),
  machine        INTEGER NOT NULL,  -- the part's
  name           INTEGER NOT NULL,  -- the characteristic's
  characteristic INTEGER NOT NULL REFERENCES characteristic (id),
  epoch          INTEGER NOT NULL,  -- and number: the record it was derived from
  number         INTEGER NOT NULL,
  item           INTEGER NOT NULL,  -- of the record's, from 0
  time_us        INTEGER NOT NULL,  -- at the gateway
  actual         REAL NOT NULL,
  verdict        INTEGER NOT NULL CHECK (verdict BETWEEN 0 AND 3),
  block          INTEGER NOT NULL,
  line           INTEGER NOT NULL,
  is_superseded  INTEGER NOT NULL DEFAULT 0 CHECK (is_superseded IN (0, 1))
) STRICT;
INSERT INTO measurement VALUES(1,1,1,1,1,7,2,0,1000002,1.5,2,20,22,0);
CREATE TABLE report_finding (
  id            INTEGER PRIMARY KEY,
  machine       INTEGER NOT NULL REFERENCES machine (id),
  part          INTEGER REFERENCES measured_part (id),  -- NULL: of none
  run           TEXT,
  epoch         INTEGER NOT NULL,  -- and number: the record at which it was found
  number        INTEGER NOT NULL,
  time_us       INTEGER NOT NULL,
  kind          TEXT NOT NULL,
  text          TEXT NOT NULL,
  is_superseded INTEGER NOT NULL DEFAULT 0 CHECK (is_superseded IN (0, 1))
) STRICT;
INSERT INTO report_finding VALUES(1,1,1,'r1',7,2,1000002,'unmatched','X3',0);
CREATE TABLE archive (
  id         INTEGER PRIMARY KEY,
  kind       TEXT NOT NULL CHECK (kind IN ('records', 'measurements')),
  machine    TEXT NOT NULL,         -- of records; of measurements empty: of all
  epoch      INTEGER NOT NULL,      -- of records: their journal
  first      INTEGER NOT NULL,      -- numbers of the records, or ids of the parts
  last       INTEGER NOT NULL,
  is_removed INTEGER NOT NULL DEFAULT 0 CHECK (is_removed IN (0, 1)),  -- its rows are no longer in the tables
  file       TEXT NOT NULL UNIQUE,  -- its name in the folder of archives
  sha256     BLOB NOT NULL CHECK (length(sha256) = 32),  -- of the file; also in its audit entry
  rows       INTEGER NOT NULL,
  bytes      INTEGER NOT NULL,      -- of the file
  first_us   INTEGER NOT NULL,
  last_us    INTEGER NOT NULL,
  created_us INTEGER NOT NULL
) STRICT;
INSERT INTO archive VALUES(1,'records','m1',3,1,4,1,'records-m1-3-1.jsonl.zst',X'0000000000000000000000000000000000000000000000000000000000000000',4,120,1700000000000000,1700000000000001,1700000000000015);
CREATE INDEX content_chunk_by_chunk ON content_chunk (chunk);
CREATE UNIQUE INDEX run_unfinished ON run (machine) WHERE state IN ('ordered', 'active');
CREATE INDEX run_by_machine ON run (machine);
CREATE INDEX run_by_program ON run (program, revision);
CREATE INDEX record_by_run ON record (run, epoch, number) WHERE run IS NOT NULL;
CREATE INDEX record_without_run ON record (machine, epoch, number) WHERE run IS NULL AND kind IN ('output', 'probe');
CREATE INDEX chunk_digest ON chunk (id, sha256);
CREATE INDEX record_of_memory ON record (machine, epoch, number) WHERE kind = 'message' AND device = 'memory';
CREATE INDEX revision_by_digest ON revision (sha256);
CREATE INDEX revision_step_by_revision ON revision_step (program, revision, id);
CREATE INDEX audit_run_end ON audit (subject) WHERE action = 'run.end';
CREATE INDEX import_pending ON import (program, revision) WHERE state = 'pending';
CREATE INDEX import_decided ON import (decided_us) WHERE state <> 'pending';
CREATE INDEX measured_part_by_run ON measured_part (run) WHERE run IS NOT NULL;
CREATE INDEX measured_part_by_machine ON measured_part (machine, begun_us);
CREATE UNIQUE INDEX characteristic_by_value ON characteristic (name, nominal, lower, upper, unit, decimals, tool);
CREATE UNIQUE INDEX measurement_by_record ON measurement (machine, epoch, number, item) WHERE is_superseded = 0;
CREATE INDEX measurement_by_characteristic ON measurement (machine, name, time_us);
CREATE INDEX measurement_by_time ON measurement (machine, time_us);
CREATE INDEX measurement_by_part ON measurement (part);
CREATE INDEX measurement_outside ON measurement (machine, time_us) WHERE verdict >= 2;
CREATE INDEX report_finding_by_run ON report_finding (run) WHERE run IS NOT NULL;
CREATE INDEX report_finding_by_machine ON report_finding (machine, time_us);
CREATE INDEX report_finding_by_part ON report_finding (part) WHERE part IS NOT NULL;
COMMIT;
PRAGMA user_version = 11;
