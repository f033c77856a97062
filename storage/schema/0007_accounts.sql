-- Version 7: users, what they sign in with, and groups of machines; the audit trail names credential and address.

CREATE TABLE user (
  name         TEXT PRIMARY KEY,
  role         TEXT NOT NULL CHECK (role IN ('viewer', 'operator', 'programmer', 'approver', 'administrator')),
  password     TEXT NOT NULL,  -- argon2id digest with salt and cost, in its own text form; empty: no password
  state        TEXT NOT NULL CHECK (state IN ('active', 'locked', 'removed')),  -- a removed user's name is never used again
  created_us   INTEGER NOT NULL,
  signed_in_us INTEGER  -- last time with the password; NULL: never
) STRICT, WITHOUT ROWID;

CREATE TABLE machine_group (name TEXT PRIMARY KEY) STRICT, WITHOUT ROWID;
INSERT INTO machine_group (name) VALUES ('all');  -- every machine, also those to come; has no members

CREATE TABLE machine_group_member (
  machine_group TEXT NOT NULL REFERENCES machine_group (name) ON DELETE CASCADE,
  machine       TEXT NOT NULL,  -- not a reference: it may not have been seen yet
  PRIMARY KEY (machine_group, machine)
) STRICT, WITHOUT ROWID;

-- The groups whose machines a user may act on.
CREATE TABLE user_group (
  user          TEXT NOT NULL REFERENCES user (name),
  machine_group TEXT NOT NULL REFERENCES machine_group (name),
  PRIMARY KEY (user, machine_group)
) STRICT, WITHOUT ROWID;

-- What a request carries instead of a password. The secret itself is stored nowhere.
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

CREATE TABLE credential_group (
  user          TEXT NOT NULL,
  name          TEXT NOT NULL,
  machine_group TEXT NOT NULL REFERENCES machine_group (name),
  PRIMARY KEY (user, name, machine_group),
  FOREIGN KEY (user, name) REFERENCES credential (user, name) ON DELETE CASCADE
) STRICT, WITHOUT ROWID;

-- The name of the token or session that was used; empty: none, or not known (a version before 7).
ALTER TABLE audit ADD COLUMN credential TEXT NOT NULL DEFAULT '';
ALTER TABLE audit ADD COLUMN address TEXT NOT NULL DEFAULT '';  -- of the client; empty: not caused by a request
