-- Version 5: stored bytes belong where they are, records carry our own time too, ages do not depend on the time of day.

-- The digest of the chunk that belongs at this place; NULL: written by a version before 5 and not sealed yet.
ALTER TABLE content_chunk ADD COLUMN sha256 BLOB CHECK (length(sha256) = 32);
-- SHA-256 over the content's digest, its size and the digests of its chunks in their order (impl/content_seal.cpp). Made when
-- all bytes had been compared with the content's digest; NULL: not committed, or not compared since version 5.
ALTER TABLE content ADD COLUMN seal BLOB CHECK (length(seal) = 32);
-- Whether every chunk of a content is the one that belongs there, without touching the chunks' pages.
CREATE INDEX chunk_digest ON chunk (id, sha256);

ALTER TABLE record ADD COLUMN received_us INTEGER;  -- at the server; NULL: stored by a version before 5

-- How long a server has run since the last piece came; replaces a comparison with touched_us.
ALTER TABLE upload ADD COLUMN idle_seconds INTEGER NOT NULL DEFAULT 0;

-- One row: which database this is. The server's folder remembers it.
CREATE TABLE identity (id TEXT PRIMARY KEY) STRICT, WITHOUT ROWID;
INSERT INTO identity (id) VALUES (lower(hex(randomblob(16))));
