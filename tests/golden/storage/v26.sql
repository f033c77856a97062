-- A database of schema version 26 with a bit of everything, as the program of that version left it.
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
, part TEXT NOT NULL DEFAULT '', operation TEXT NOT NULL DEFAULT '', material TEXT NOT NULL DEFAULT '', machine_group TEXT NOT NULL DEFAULT '', latest INTEGER, revisions INTEGER NOT NULL DEFAULT 0, held INTEGER NOT NULL DEFAULT 0, released INTEGER, latest_control TEXT, latest_author TEXT, latest_state TEXT) STRICT;
INSERT INTO program VALUES(1,'p.nc',0,'4711','','','lathes',2,3,1,NULL,'centurion','cam','draft');
INSERT INTO program VALUES(2,'gone.nc',1,'','','','',NULL,0,0,NULL,NULL,NULL,NULL);
CREATE TABLE revision (
  program    INTEGER NOT NULL REFERENCES program (id),
  number     INTEGER NOT NULL CHECK (number >= 1),  -- 1, 2, 3 ... per program, never used twice
  content    INTEGER NOT NULL REFERENCES content (id),
  control    TEXT NOT NULL,  -- dialect name, or empty when not known
  comment    TEXT NOT NULL,
  author     TEXT NOT NULL,
  created_us INTEGER NOT NULL, standing TEXT NOT NULL DEFAULT 'accepted'
  CHECK (standing IN ('accepted', 'held', 'rejected')), accepted_us INTEGER, sha256 BLOB CHECK (length(sha256) = 32), state TEXT NOT NULL DEFAULT 'draft'
  CHECK (state IN ('draft', 'in_review', 'approved', 'released', 'withdrawn')), released_us INTEGER, withdrawn_us INTEGER, cam_file TEXT NOT NULL DEFAULT '', in_force_after INTEGER, released_after INTEGER, withdrawn_after INTEGER,
  PRIMARY KEY (program, number)
) STRICT, WITHOUT ROWID;
INSERT INTO revision VALUES(1,1,1,'centurion','a comment','cam',1700000000000000,'accepted',NULL,X'82fd126da9155a17a769ba10a60e7fa955e96af4fb37dca49e5dbe7d1468d450','withdrawn',NULL,1700000000000011,'',0,NULL,4);
INSERT INTO revision VALUES(1,2,2,'centurion','a comment','cam',1700000000000000,'accepted',NULL,X'3e260f07836b82fd7b65aac368f8d95d67bdf637f8b4aabe75fff65af29bb3f1','draft',NULL,NULL,'p.f3d',NULL,NULL,NULL);
INSERT INTO revision VALUES(1,3,3,'centurion','punched','machine m1',1700000000000000,'held',NULL,X'da2477a3c847cd3b0b5aa488874b00bd5e960e56eb059a5fb483fb70d2dc57e0','draft',NULL,NULL,'',NULL,NULL,NULL);
INSERT INTO revision VALUES(2,1,3,'centurion','a comment','cam',1700000000000000,'accepted',NULL,X'da2477a3c847cd3b0b5aa488874b00bd5e960e56eb059a5fb483fb70d2dc57e0','draft',NULL,NULL,'',NULL,NULL,NULL);
CREATE TABLE upload (
  id         TEXT PRIMARY KEY,
  program    TEXT NOT NULL,  -- its name; the program comes to be with its first revision
  control    TEXT NOT NULL,
  comment    TEXT NOT NULL,
  author     TEXT NOT NULL,
  content    INTEGER NOT NULL UNIQUE REFERENCES content (id),  -- its size is what was received
  created_us INTEGER NOT NULL,
  touched_us INTEGER NOT NULL  -- when the last piece came
, held INTEGER NOT NULL DEFAULT 0 CHECK (held IN (0, 1)), idle_seconds INTEGER NOT NULL DEFAULT 0, part TEXT, operation TEXT, material TEXT, machine_group TEXT, cam_file TEXT, attachment TEXT, attachment_revision INTEGER, folder_file INTEGER) STRICT, WITHOUT ROWID;
INSERT INTO upload VALUES('u1','half.nc','','','cam',4,1700000000000000,1700000000000000,0,0,NULL,NULL,NULL,NULL,NULL,NULL,NULL,NULL);
CREATE TABLE machine (
  id              INTEGER PRIMARY KEY,
  name            TEXT NOT NULL UNIQUE,
  control         TEXT NOT NULL,
  description     TEXT NOT NULL,
  gateway_version TEXT NOT NULL,
  epoch           INTEGER NOT NULL,  -- of its records: the gateway's journal it numbers them in
  first_seen_us   INTEGER NOT NULL,
  last_seen_us    INTEGER NOT NULL
, removed_us INTEGER) STRICT;
INSERT INTO machine VALUES(1,'m1','centurion','','',7,1700000000000000,1700000000000000,NULL);
INSERT INTO machine VALUES(2,'m9','centurion','','',1,1,2,3);
CREATE TABLE run (
  number           INTEGER PRIMARY KEY,  -- order of creation
  id               TEXT NOT NULL UNIQUE,
  machine          INTEGER NOT NULL REFERENCES machine (id),
  program          INTEGER NOT NULL,
  revision         INTEGER NOT NULL,
  control          TEXT NOT NULL,  -- the dialect it runs as
  state            TEXT NOT NULL CHECK (state IN
    ('ordered', 'active', 'completed', 'aborted', 'alarmed', 'interrupted', 'refused', 'tested')),
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
  outputs          INTEGER NOT NULL DEFAULT 0, setup INTEGER, sha256 BLOB CHECK (length(sha256) = 32), allowed_as TEXT NOT NULL DEFAULT 'open' CHECK (allowed_as IN ('open', 'released', 'prove_out')), approval INTEGER REFERENCES revision_step (id), job INTEGER REFERENCES job (id), gateway_setup TEXT, motion_seconds REAL CHECK (motion_seconds >= 0), path_mm REAL CHECK (path_mm >= 0), is_test INTEGER NOT NULL DEFAULT 0 CHECK (is_test IN (0, 1)),  -- stored records of kind output
  FOREIGN KEY (program, revision) REFERENCES revision (program, number)
) STRICT;
INSERT INTO run VALUES(1,'r1',1,1,1,'centurion','completed',12,2,2,0,-1,'M30',NULL,1,'operator',1700000000000000,3,5,1,1,X'82fd126da9155a17a769ba10a60e7fa955e96af4fb37dca49e5dbe7d1468d450','open',NULL,1,NULL,12.5,250.74999999999999999,0);
INSERT INTO run VALUES(2,'r2',1,1,2,'centurion','active',0,0,0,0,-1,'',NULL,NULL,'operator',1700000000000000,NULL,NULL,0,NULL,X'3e260f07836b82fd7b65aac368f8d95d67bdf637f8b4aabe75fff65af29bb3f1','open',NULL,NULL,'aaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaa',NULL,NULL,0);
INSERT INTO run VALUES(3,'r3',1,1,1,'centurion','tested',12,2,0,0,-1,'test run: 2 blocks',NULL,1,'operator',1700000000000000,3,5,0,1,X'82fd126da9155a17a769ba10a60e7fa955e96af4fb37dca49e5dbe7d1468d450','open',NULL,NULL,NULL,NULL,NULL,0);
INSERT INTO run VALUES(4,'r4',1,1,1,'centurion','interrupted',12,2,0,0,-1,'the server stopped',NULL,1,'operator',1700000000000000,3,5,0,1,X'82fd126da9155a17a769ba10a60e7fa955e96af4fb37dca49e5dbe7d1468d450','open',NULL,NULL,NULL,NULL,NULL,1);
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
, host TEXT NOT NULL DEFAULT '') STRICT, WITHOUT ROWID;
INSERT INTO port VALUES('line-1','m1','/dev/ttyUSB0','tnc155',replace('[[rule]]\n','\n',char(10)),1,'srv-1');
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
  signature  BLOB NOT NULL CHECK (length(signature) = 64), closure INTEGER CHECK (closure IS NULL OR step = 'release'),  -- Ed25519, by the server (server/library/releases.hpp)
  FOREIGN KEY (program, revision) REFERENCES revision (program, number)
) STRICT;
INSERT INTO revision_step VALUES(1,1,1,'p.nc',X'82fd126da9155a17a769ba10a60e7fa955e96af4fb37dca49e5dbe7d1468d450','withdraw',1700000000000011,'anna','dashboard','192.0.2.7','scrap',X'0000000000000000000000000000000000000000000000000000000000000000',X'00000000000000000000000000000000000000000000000000000000000000000000000000000000000000000000000000000000000000000000000000000000',NULL);
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
, is_counted INTEGER NOT NULL DEFAULT 1 CHECK (is_counted IN (0, 1))) STRICT;
INSERT INTO archive VALUES(1,'records','m1',3,1,4,1,'records-m1-3-1.jsonl.zst',X'0000000000000000000000000000000000000000000000000000000000000000',4,120,1700000000000000,1700000000000001,1700000000000015,1);
INSERT INTO archive VALUES(2,'measurements','',0,1,2,1,'measurements-1.jsonl.zst',X'0000000000000000000000000000000000000000000000000000000000000000',4,120,1700000000000000,1700000000000001,1700000000000016,1);
CREATE TABLE offset_rules (
  machine    TEXT NOT NULL,
  version    INTEGER NOT NULL CHECK (version >= 1),
  text       TEXT NOT NULL,  -- TOML (server/offsets)
  author     TEXT NOT NULL,
  created_us INTEGER NOT NULL,
  PRIMARY KEY (machine, version)
) STRICT, WITHOUT ROWID;
INSERT INTO offset_rules VALUES('m1',1,replace('[[rule]]\n','\n',char(10)),'quality',1700000000000000);
CREATE TABLE offset_proposal (
  id         INTEGER PRIMARY KEY AUTOINCREMENT,  -- never used again
  machine    TEXT NOT NULL,
  rule       TEXT NOT NULL,     -- its name in the rules
  target     TEXT NOT NULL,     -- T3.wear.X, G54.Z, #500
  unit       TEXT NOT NULL,     -- of both values: mm or in, the setup's
  old_value  REAL NOT NULL,
  new_value  REAL NOT NULL,
  base       INTEGER NOT NULL,  -- the setup it was made from; 0: there was none
  state      TEXT NOT NULL DEFAULT 'pending' CHECK (state IN ('pending', 'applied', 'rejected', 'superseded')),
  used       INTEGER NOT NULL,  -- measurements
  left_out   INTEGER NOT NULL,  -- outliers
  mean       REAL NOT NULL,     -- deviation, in the characteristic's unit
  first      INTEGER NOT NULL,  -- measurement, by its id
  last       INTEGER NOT NULL,
  reasons    TEXT NOT NULL,     -- JSON array of texts
  created_us INTEGER NOT NULL,
  decided_us INTEGER,           -- NULL: pending
  who        TEXT NOT NULL DEFAULT '',
  comment    TEXT NOT NULL DEFAULT '',
  is_automatic INTEGER NOT NULL DEFAULT 0 CHECK (is_automatic IN (0, 1)),  -- applied within the policy, without a person
  setup      INTEGER,           -- applied: the setup that it became
  CHECK ((state = 'applied') = (setup IS NOT NULL))
) STRICT;
INSERT INTO offset_proposal VALUES(1,'m1','bore','T3.wear.X','mm',0.0,-0.020000000000000000416,1,'applied',5,1,0.020000000000000000416,1,1,'["mean 0.02"]',1700000000000000,1700000001000000,'quality','',0,2);
INSERT INTO offset_proposal VALUES(2,'m1','bore','T3.wear.X','mm',-0.020000000000000000416,-0.029999999999999998889,2,'pending',5,0,0.010000000000000000208,1,1,'["mean 0.01"]',1700000002000000,NULL,'','',0,NULL);
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
INSERT INTO attachment VALUES(1,1,NULL,'setup.txt',1,X'82fd126da9155a17a769ba10a60e7fa955e96af4fb37dca49e5dbe7d1468d450','side 1','anna',1700000000000000);
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
CREATE TABLE search_document (
  id       INTEGER PRIMARY KEY AUTOINCREMENT,  -- its row in search_index; what changed last has the highest
  program  INTEGER NOT NULL,
  revision INTEGER NOT NULL,
  words    TEXT NOT NULL,     -- those that are not of the text: given again when the document is taken out
  text     INTEGER NOT NULL,  -- bytes of the text whose words it has
  UNIQUE (program, revision)
) STRICT;
PRAGMA writable_schema=ON;
INSERT INTO sqlite_schema(type,name,tbl_name,rootpage,sql)VALUES('table','search_index','search_index',0,'CREATE VIRTUAL TABLE search_index USING fts5 (
  words, content = '''', detail = none, columnsize = 0, tokenize = "ascii tokenchars ''.-$''")');
CREATE TABLE IF NOT EXISTS 'search_index_data'(id INTEGER PRIMARY KEY, block BLOB);
INSERT INTO search_index_data VALUES(1,X'');
INSERT INTO search_index_data VALUES(10,X'00000000000000');
CREATE TABLE IF NOT EXISTS 'search_index_idx'(segid, term, pgno, PRIMARY KEY(segid, term)) WITHOUT ROWID;
CREATE TABLE IF NOT EXISTS 'search_index_config'(k PRIMARY KEY, v) WITHOUT ROWID;
INSERT INTO search_index_config VALUES('version',4);
CREATE TABLE search_due (
  program INTEGER PRIMARY KEY REFERENCES program (id),
  version INTEGER NOT NULL DEFAULT 1
) STRICT;
INSERT INTO search_due VALUES(1,5);
INSERT INTO search_due VALUES(2,2);
CREATE TABLE folder_file (
  id         INTEGER PRIMARY KEY AUTOINCREMENT,  -- never used twice: an upload names it
  folder     TEXT NOT NULL,  -- its name in the configuration
  name       TEXT NOT NULL,  -- of the file
  sha256     BLOB NOT NULL CHECK (length(sha256) = 32),
  size       INTEGER NOT NULL CHECK (size >= 0),
  changed_ns INTEGER NOT NULL,  -- the file's time of change, nanoseconds since 1970
  state      TEXT NOT NULL CHECK (state IN ('taken', 'stored', 'failed')),
  program    TEXT NOT NULL DEFAULT '',  -- stored: its name then
  revision   INTEGER,                   -- stored
  reason     TEXT NOT NULL DEFAULT '',  -- failed: why, for people
  target     TEXT NOT NULL DEFAULT '',  -- below the folder, where it is moved; empty: not chosen yet
  taken_us   INTEGER NOT NULL,
  moved_us   INTEGER                    -- NULL: it is still in its folder
) STRICT;
INSERT INTO folder_file VALUES(1,'cam','p.nc',X'3e260f07836b82fd7b65aac368f8d95d67bdf637f8b4aabe75fff65af29bb3f1',11,1700000000000000000,'stored','p.nc',2,'','done/p.nc',1700000000000000,NULL);
CREATE TABLE job (
  id            INTEGER PRIMARY KEY AUTOINCREMENT,
  machine       INTEGER NOT NULL REFERENCES machine (id),
  position      INTEGER NOT NULL,  -- order within the machine; gaps mean nothing
  program       INTEGER NOT NULL REFERENCES program (id),
  revision      INTEGER,           -- NULL: the latest that may run when it is started
  quantity      INTEGER NOT NULL CHECK (quantity >= 1),       -- parts that are wanted
  parts_per_run INTEGER NOT NULL CHECK (parts_per_run >= 1),
  comment       TEXT NOT NULL,
  author        TEXT NOT NULL,
  created_us    INTEGER NOT NULL,
  removed_us    INTEGER            -- NULL: it is in the queue
, counts TEXT NOT NULL DEFAULT 'made' CHECK (counts IN ('made', 'good'))) STRICT;
INSERT INTO job VALUES(1,1,1,1,NULL,3,1,'steel','anna',1700000000000000,NULL,'made');
INSERT INTO job VALUES(2,1,2,1,NULL,5,1,'','anna',1700000000000016,NULL,'good');
CREATE TABLE job_hold (
  machine  INTEGER PRIMARY KEY REFERENCES machine (id),
  who      TEXT NOT NULL,
  reason   TEXT NOT NULL,
  since_us INTEGER NOT NULL
) STRICT;
INSERT INTO job_hold VALUES(1,'quality','bore is wide',1700000000000000);
CREATE TABLE webhook (
  id               INTEGER PRIMARY KEY AUTOINCREMENT,
  name             TEXT NOT NULL UNIQUE,
  url              TEXT NOT NULL,
  secret           TEXT NOT NULL,     -- signs what is sent; it must be readable for that
  kinds            TEXT NOT NULL,     -- of events, with commas; empty: all
  author           TEXT NOT NULL,
  created_us       INTEGER NOT NULL,
  delivered        INTEGER NOT NULL,  -- the last event that was delivered, or passed over
  delivered_us     INTEGER,           -- when
  failures         INTEGER NOT NULL DEFAULT 0,  -- since the last success
  failing_since_us INTEGER,           -- NULL: it is not failing
  fault            TEXT NOT NULL DEFAULT '',    -- of the last failure
  lost             INTEGER NOT NULL DEFAULT 0   -- events that were dropped before they could be delivered
) STRICT;
INSERT INTO webhook VALUES(1,'erp','https://erp.example/','s3cret','run,alarm','admin',1700000000000000,0,NULL,0,NULL,'',0);
CREATE TABLE event (
  id      INTEGER PRIMARY KEY AUTOINCREMENT,  -- in the order of their transactions; never used twice
  time_us INTEGER NOT NULL,                   -- when it was stored
  kind    TEXT NOT NULL,                      -- revision, run, alarm, import, job, part
  data    TEXT NOT NULL                       -- JSON
) STRICT;
INSERT INTO event VALUES(1,1700000000000000,'run','{"run":"r1"}');
INSERT INTO event VALUES(3,1795829803625000,'job','{"change":"added","job":2,"machine":"m1","program":"p.nc","revision":null,"quantity":5,"completed":0}');
INSERT INTO event VALUES(4,1795980068240000,'run','{"run":"r3","state":"tested","machine":"m1","program":"p.nc","revision":1,"author":"operator","job":null,"executed":0,"reason":"test run: 2 blocks"}');
INSERT INTO event VALUES(5,1796005800013000,'run','{"run":"r4","state":"interrupted","machine":"m1","program":"p.nc","revision":1,"author":"operator","job":null,"executed":0,"reason":"the server stopped"}');
CREATE TABLE run_call (
  run      INTEGER NOT NULL REFERENCES run (number),
  name     TEXT NOT NULL,     -- as the program calls it
  program  INTEGER NOT NULL REFERENCES program (id),
  revision INTEGER NOT NULL,
  sha256   BLOB NOT NULL CHECK (length(sha256) = 32),
  PRIMARY KEY (run, name)
) STRICT, WITHOUT ROWID;
INSERT INTO run_call VALUES(2,'1',1,1,X'82fd126da9155a17a769ba10a60e7fa955e96af4fb37dca49e5dbe7d1468d450');
CREATE TABLE search_word (word TEXT NOT NULL PRIMARY KEY) STRICT, WITHOUT ROWID;
CREATE TABLE record_reader (
  name     TEXT PRIMARY KEY,
  since_us INTEGER NOT NULL
) STRICT, WITHOUT ROWID;
INSERT INTO record_reader VALUES('mqtt',1700000000000000);
CREATE TABLE record_cursor (
  reader  TEXT NOT NULL REFERENCES record_reader (name),
  machine INTEGER NOT NULL REFERENCES machine (id),
  epoch   INTEGER NOT NULL,
  number  INTEGER NOT NULL,
  PRIMARY KEY (reader, machine, epoch)
) STRICT, WITHOUT ROWID;
INSERT INTO record_cursor VALUES('mqtt',1,7,2);
CREATE TABLE archived_part (
  run      TEXT NOT NULL,
  archive  INTEGER NOT NULL REFERENCES archive (id),
  template TEXT NOT NULL,
  verdict  INTEGER NOT NULL CHECK (verdict BETWEEN 0 AND 3),  -- as measured_part.verdict
  parts    INTEGER NOT NULL CHECK (parts > 0),
  PRIMARY KEY (run, archive, template, verdict)
) STRICT, WITHOUT ROWID;
INSERT INTO archived_part VALUES('r1',2,'bore',0,2);
CREATE TABLE machine_hold (
  machine  INTEGER PRIMARY KEY REFERENCES machine (id),
  run      TEXT NOT NULL,  -- its id; empty: of no run
  who      TEXT NOT NULL,
  reason   TEXT NOT NULL,  -- empty: none was given
  since_us INTEGER NOT NULL
) STRICT;
INSERT INTO machine_hold VALUES(1,'r2','report template bore version 1','part 1 S7 is scrap',1700000000000017);
CREATE TABLE loaded_setup (
  machine   TEXT PRIMARY KEY,  -- not a reference, as in setup
  number    INTEGER,           -- NULL: not known
  who       TEXT NOT NULL,
  loaded_us INTEGER NOT NULL,
  FOREIGN KEY (machine, number) REFERENCES setup (machine, number)
) STRICT, WITHOUT ROWID;
INSERT INTO loaded_setup VALUES('m1',1,'anna',1700000000000018);
CREATE TABLE port_transfer (
  port      TEXT NOT NULL REFERENCES port (name) ON DELETE CASCADE,
  direction TEXT NOT NULL CHECK (direction IN ('send', 'receive')),
  id        TEXT NOT NULL,
  programs  TEXT NOT NULL,  -- one a line, as people read them; what is received may have no name yet
  size      INTEGER NOT NULL CHECK (size >= 0),      -- bytes; 0 while it is not known
  passed    INTEGER NOT NULL CHECK (passed >= 0),    -- bytes that have passed the line for certain
  at_most   INTEGER NOT NULL CHECK (at_most >= 0),   -- bytes that may have passed it: stored before they leave
  state     TEXT NOT NULL CHECK (state IN ('active', 'completed', 'aborted', 'interrupted')),
  reason    TEXT NOT NULL,  -- why it was not completed, for people
  began_us  INTEGER NOT NULL,
  ended_us  INTEGER, after_run TEXT,        -- NULL while it is active
  PRIMARY KEY (port, direction),
  CHECK ((state = 'active') = (ended_us IS NULL))
) STRICT, WITHOUT ROWID;
INSERT INTO port_transfer VALUES('line-1','receive','reception-1','',0,100,100,'interrupted','the line is lost',1700000000000000,1700000001000000,NULL);
INSERT INTO port_transfer VALUES('line-1','send','transfer-1',replace('p.nc revision 1\np.nc revision 2','\n',char(10)),26,12,26,'active','',1700000000000000,NULL,'r1');
DELETE FROM sqlite_sequence;
INSERT INTO sqlite_sequence VALUES('offset_proposal',2);
INSERT INTO sqlite_sequence VALUES('folder_file',1);
INSERT INTO sqlite_sequence VALUES('event',5);
INSERT INTO sqlite_sequence VALUES('job',2);
INSERT INTO sqlite_sequence VALUES('webhook',1);
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
CREATE UNIQUE INDEX offset_proposal_pending ON offset_proposal (machine, target) WHERE state = 'pending';
CREATE INDEX offset_proposal_by_machine ON offset_proposal (machine, id);
CREATE UNIQUE INDEX offset_proposal_by_setup ON offset_proposal (machine, setup) WHERE setup IS NOT NULL;
CREATE INDEX run_by_setup ON run (machine, setup) WHERE setup IS NOT NULL;
CREATE INDEX program_listed ON program (name) WHERE latest IS NOT NULL;
CREATE INDEX program_by_part ON program (part, name) WHERE latest IS NOT NULL;
CREATE INDEX program_by_operation ON program (operation, name) WHERE latest IS NOT NULL;
CREATE INDEX program_by_material ON program (material, name) WHERE latest IS NOT NULL;
CREATE INDEX program_by_group ON program (machine_group, name) WHERE latest IS NOT NULL;
CREATE INDEX program_by_control ON program (latest_control, name) WHERE latest IS NOT NULL;
CREATE INDEX program_by_author ON program (latest_author, name) WHERE latest IS NOT NULL;
CREATE INDEX program_by_state ON program (latest_state, name) WHERE latest IS NOT NULL;
CREATE INDEX revision_by_content ON revision (content);
CREATE UNIQUE INDEX attachment_by_name ON attachment (program, coalesce(revision, 0), name);
CREATE INDEX attachment_by_digest ON attachment (sha256);
CREATE INDEX attachment_by_content ON attachment (content);
CREATE INDEX revision_pin_by_revision ON revision_pin (program, revision);
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
END
;
CREATE TRIGGER program_described AFTER UPDATE OF name, part, operation, material, machine_group ON program BEGIN
  INSERT INTO search_due (program) VALUES (NEW.id) ON CONFLICT (program) DO UPDATE SET version = version + 1;
END;
CREATE TRIGGER attachment_added AFTER INSERT ON attachment BEGIN
  INSERT INTO search_due (program) VALUES (NEW.program) ON CONFLICT (program) DO UPDATE SET version = version + 1;
END;
CREATE TRIGGER attachment_removed AFTER DELETE ON attachment BEGIN
  INSERT INTO search_due (program) VALUES (OLD.program) ON CONFLICT (program) DO UPDATE SET version = version + 1;
END;
CREATE UNIQUE INDEX folder_file_unfinished ON folder_file (folder, name) WHERE moved_us IS NULL;
CREATE INDEX folder_file_by_folder ON folder_file (folder, state);
CREATE INDEX job_by_machine ON job (machine, position);
CREATE INDEX run_by_job ON run (job, state) WHERE job IS NOT NULL;
CREATE TRIGGER event_of_new_revision AFTER INSERT ON revision WHEN EXISTS (SELECT 1 FROM webhook)
BEGIN
  INSERT INTO event (time_us, kind, data) VALUES (
    CAST((julianday('now') - 2440587.5) * 86400000 AS INTEGER) * 1000, 'revision',
    json_object('change', 'stored', 'program', (SELECT name FROM program WHERE id = new.program), 'revision', new.number,
      'state', new.state, 'held', json(iif(new.standing = 'held', 'true', 'false')), 'control', new.control,
      'author', new.author, 'comment', new.comment, 'sha256', lower(hex(new.sha256))));
END;
CREATE TRIGGER event_of_revision_state AFTER UPDATE OF state ON revision
WHEN new.state <> old.state AND EXISTS (SELECT 1 FROM webhook)
BEGIN
  INSERT INTO event (time_us, kind, data) VALUES (
    CAST((julianday('now') - 2440587.5) * 86400000 AS INTEGER) * 1000, 'revision',
    json_object('change', 'state', 'program', (SELECT name FROM program WHERE id = new.program), 'revision', new.number,
      'state', new.state, 'before', old.state, 'author', new.author, 'sha256', lower(hex(new.sha256))));
END;
CREATE TRIGGER event_of_new_run AFTER INSERT ON run WHEN EXISTS (SELECT 1 FROM webhook)
BEGIN
  INSERT INTO event (time_us, kind, data) VALUES (
    CAST((julianday('now') - 2440587.5) * 86400000 AS INTEGER) * 1000, 'run',
    json_object('run', new.id, 'state', new.state, 'machine', (SELECT name FROM machine WHERE id = new.machine),
      'program', (SELECT name FROM program WHERE id = new.program), 'revision', new.revision, 'author', new.author,
      'job', new.job, 'executed', new.executed, 'reason', new.reason));
END;
CREATE TRIGGER event_of_run_state AFTER UPDATE OF state ON run
WHEN new.state <> old.state AND EXISTS (SELECT 1 FROM webhook)
BEGIN
  INSERT INTO event (time_us, kind, data) VALUES (
    CAST((julianday('now') - 2440587.5) * 86400000 AS INTEGER) * 1000, 'run',
    json_object('run', new.id, 'state', new.state, 'machine', (SELECT name FROM machine WHERE id = new.machine),
      'program', (SELECT name FROM program WHERE id = new.program), 'revision', new.revision, 'author', new.author,
      'job', new.job, 'executed', new.executed, 'reason', new.reason));
END;
CREATE TRIGGER event_of_alarm AFTER INSERT ON record WHEN new.kind = 'alarm' AND EXISTS (SELECT 1 FROM webhook)
BEGIN
  INSERT INTO event (time_us, kind, data) VALUES (
    CAST((julianday('now') - 2440587.5) * 86400000 AS INTEGER) * 1000, 'alarm',
    json_object('machine', (SELECT name FROM machine WHERE id = new.machine), 'run', new.run, 'line', new.line,
      'text', new.text, 'epoch', new.epoch, 'number', new.number));
END;
CREATE TRIGGER event_of_new_import AFTER INSERT ON import WHEN EXISTS (SELECT 1 FROM webhook)
BEGIN
  INSERT INTO event (time_us, kind, data) VALUES (
    CAST((julianday('now') - 2440587.5) * 86400000 AS INTEGER) * 1000, 'import',
    json_object('program', (SELECT name FROM program WHERE id = new.program), 'revision', new.revision, 'state', new.state,
      'machine', new.machine, 'class', new.class, 'who', new.who, 'reason', new.reason));
END;
CREATE TRIGGER event_of_import_state AFTER UPDATE OF state ON import
WHEN new.state <> old.state AND EXISTS (SELECT 1 FROM webhook)
BEGIN
  INSERT INTO event (time_us, kind, data) VALUES (
    CAST((julianday('now') - 2440587.5) * 86400000 AS INTEGER) * 1000, 'import',
    json_object('program', (SELECT name FROM program WHERE id = new.program), 'revision', new.revision, 'state', new.state,
      'machine', new.machine, 'class', new.class, 'who', new.who, 'reason', new.reason));
END;
CREATE TRIGGER event_of_new_job AFTER INSERT ON job WHEN EXISTS (SELECT 1 FROM webhook)
BEGIN
  INSERT INTO event (time_us, kind, data) VALUES (
    CAST((julianday('now') - 2440587.5) * 86400000 AS INTEGER) * 1000, 'job',
    json_object('change', 'added', 'job', new.id, 'machine', (SELECT name FROM machine WHERE id = new.machine),
      'program', (SELECT name FROM program WHERE id = new.program), 'revision', new.revision, 'quantity', new.quantity,
      'completed', 0));
END;
CREATE TRIGGER event_of_removed_job AFTER UPDATE OF removed_us ON job
WHEN new.removed_us IS NOT NULL AND old.removed_us IS NULL AND EXISTS (SELECT 1 FROM webhook)
BEGIN
  INSERT INTO event (time_us, kind, data) VALUES (
    CAST((julianday('now') - 2440587.5) * 86400000 AS INTEGER) * 1000, 'job',
    json_object('change', 'removed', 'job', new.id, 'machine', (SELECT name FROM machine WHERE id = new.machine),
      'program', (SELECT name FROM program WHERE id = new.program), 'revision', new.revision, 'quantity', new.quantity,
      'completed', new.parts_per_run * (SELECT count(*) FROM run WHERE run.job = new.id AND run.state = 'completed')));
END;
CREATE TRIGGER event_of_job_hold AFTER INSERT ON job_hold WHEN EXISTS (SELECT 1 FROM webhook)
BEGIN
  INSERT INTO event (time_us, kind, data) VALUES (
    CAST((julianday('now') - 2440587.5) * 86400000 AS INTEGER) * 1000, 'job',
    json_object('change', 'held', 'machine', (SELECT name FROM machine WHERE id = new.machine), 'who', new.who, 'reason', new.reason));
END;
CREATE TRIGGER event_of_job_release AFTER DELETE ON job_hold WHEN EXISTS (SELECT 1 FROM webhook)
BEGIN
  INSERT INTO event (time_us, kind, data) VALUES (
    CAST((julianday('now') - 2440587.5) * 86400000 AS INTEGER) * 1000, 'job',
    json_object('change', 'released', 'machine', (SELECT name FROM machine WHERE id = old.machine)));
END;
CREATE TRIGGER event_of_new_part AFTER INSERT ON measured_part
WHEN (new.verdict >= 2 OR new.ended_us IS NOT NULL) AND EXISTS (SELECT 1 FROM webhook)
BEGIN
  INSERT INTO event (time_us, kind, data) VALUES (
    CAST((julianday('now') - 2440587.5) * 86400000 AS INTEGER) * 1000, 'part',
    json_object('part', new.id, 'machine', (SELECT name FROM machine WHERE id = new.machine), 'run', new.run,
      'program', new.program, 'number', new.number, 'serial', new.serial,
      'verdict', CASE new.verdict WHEN 0 THEN 'good' WHEN 1 THEN 'unknown' WHEN 2 THEN 'rework' ELSE 'scrap' END));
END;
CREATE TRIGGER event_of_verdict AFTER UPDATE OF verdict, ended_us ON measured_part
WHEN ((new.verdict >= 2 AND new.verdict <> old.verdict)
      OR (new.verdict < 2 AND new.ended_us IS NOT NULL AND old.ended_us IS NULL)) AND EXISTS (SELECT 1 FROM webhook)
BEGIN
  INSERT INTO event (time_us, kind, data) VALUES (
    CAST((julianday('now') - 2440587.5) * 86400000 AS INTEGER) * 1000, 'part',
    json_object('part', new.id, 'machine', (SELECT name FROM machine WHERE id = new.machine), 'run', new.run,
      'program', new.program, 'number', new.number, 'serial', new.serial,
      'verdict', CASE new.verdict WHEN 0 THEN 'good' WHEN 1 THEN 'unknown' WHEN 2 THEN 'rework' ELSE 'scrap' END));
END;
CREATE TRIGGER event_of_job_progress AFTER UPDATE OF state ON run
WHEN new.job IS NOT NULL AND new.state = 'completed' AND old.state <> 'completed' AND EXISTS (SELECT 1 FROM webhook)
BEGIN
  INSERT INTO event (time_us, kind, data)
    SELECT CAST((julianday('now') - 2440587.5) * 86400000 AS INTEGER) * 1000, 'job',
      json_object('change', iif(iif(job.counts = 'good', c.good, c.made) >= job.quantity, 'done', 'progress'), 'job', job.id,
        'machine', (SELECT name FROM machine WHERE id = job.machine), 'program', (SELECT name FROM program WHERE id = job.program),
        'revision', job.revision, 'quantity', job.quantity, 'completed', c.made, 'counts', job.counts, 'good', c.good)
    FROM job JOIN job_count AS c ON c.job = job.id WHERE job.id = new.job;
END;
CREATE TRIGGER event_of_new_good_part AFTER INSERT ON measured_part
WHEN new.verdict = 0 AND new.ended_us IS NOT NULL AND new.run IS NOT NULL AND EXISTS (SELECT 1 FROM webhook)
BEGIN
  INSERT INTO event (time_us, kind, data)
    SELECT CAST((julianday('now') - 2440587.5) * 86400000 AS INTEGER) * 1000, 'job',
      json_object('change', iif(c.good >= job.quantity, 'done', 'progress'), 'job', job.id,
        'machine', (SELECT name FROM machine WHERE id = job.machine), 'program', (SELECT name FROM program WHERE id = job.program),
        'revision', job.revision, 'quantity', job.quantity, 'completed', c.made, 'counts', job.counts, 'good', c.good)
    FROM run JOIN job ON job.id = run.job JOIN job_count AS c ON c.job = job.id
    WHERE run.id = new.run AND run.state = 'completed' AND job.counts = 'good';
END;
CREATE TRIGGER event_of_good_part AFTER UPDATE OF verdict, ended_us ON measured_part
WHEN new.verdict = 0 AND new.ended_us IS NOT NULL AND old.ended_us IS NULL AND new.run IS NOT NULL AND EXISTS (SELECT 1 FROM webhook)
BEGIN
  INSERT INTO event (time_us, kind, data)
    SELECT CAST((julianday('now') - 2440587.5) * 86400000 AS INTEGER) * 1000, 'job',
      json_object('change', iif(c.good >= job.quantity, 'done', 'progress'), 'job', job.id,
        'machine', (SELECT name FROM machine WHERE id = job.machine), 'program', (SELECT name FROM program WHERE id = job.program),
        'revision', job.revision, 'quantity', job.quantity, 'completed', c.made, 'counts', job.counts, 'good', c.good)
    FROM run JOIN job ON job.id = run.job JOIN job_count AS c ON c.job = job.id
    WHERE run.id = new.run AND run.state = 'completed' AND job.counts = 'good';
END;
CREATE VIEW run_verdicts AS SELECT run.id AS run, run.job, run.state,
  (SELECT coalesce(min(parts), 0) FROM (
    SELECT sum(iif(verdict = 0, parts, 0)) AS parts FROM (
      SELECT template, verdict, 1 AS parts FROM measured_part WHERE run = run.id AND is_superseded = 0 AND ended_us IS NOT NULL
      UNION ALL SELECT template, verdict, parts FROM archived_part WHERE run = run.id)
    GROUP BY template)) AS good,
  (SELECT coalesce(max(parts), 0) FROM (
    SELECT sum(iif(verdict = 0, 0, parts)) AS parts FROM (
      SELECT template, verdict, 1 AS parts FROM measured_part WHERE run = run.id AND is_superseded = 0 AND ended_us IS NOT NULL
      UNION ALL SELECT template, verdict, parts FROM archived_part WHERE run = run.id)
    GROUP BY template)) AS not_good,
  (SELECT coalesce(max(parts), 0) FROM (
    SELECT sum(iif(verdict = 2, parts, 0)) AS parts FROM (
      SELECT template, verdict, 1 AS parts FROM measured_part WHERE run = run.id AND is_superseded = 0 AND ended_us IS NOT NULL
      UNION ALL SELECT template, verdict, parts FROM archived_part WHERE run = run.id)
    GROUP BY template)) AS rework,
  (SELECT coalesce(max(parts), 0) FROM (
    SELECT sum(iif(verdict = 3, parts, 0)) AS parts FROM (
      SELECT template, verdict, 1 AS parts FROM measured_part WHERE run = run.id AND is_superseded = 0 AND ended_us IS NOT NULL
      UNION ALL SELECT template, verdict, parts FROM archived_part WHERE run = run.id)
    GROUP BY template)) AS scrap
FROM run;
CREATE VIEW job_count AS SELECT job.id AS job,
  job.parts_per_run * (SELECT count(*) FROM run WHERE run.job = job.id AND run.state = 'completed') AS made,
  (SELECT coalesce(sum(max(0, min(v.good, job.parts_per_run - v.not_good))), 0)
    FROM run_verdicts AS v WHERE v.job = job.id AND v.state = 'completed') AS good
FROM job;
PRAGMA writable_schema=OFF;
COMMIT;
PRAGMA user_version = 26;
