-- Version 6: a revision and a run carry the digest of their content themselves, so that a row that names another content is
-- noticed; what a control keeps is found without reading all records of its machine.

-- SHA-256 of all bytes, as they were when the revision was made. `content` must be the one with this digest.
ALTER TABLE revision ADD COLUMN sha256 BLOB CHECK (length(sha256) = 32);
UPDATE revision SET sha256 = (SELECT sha256 FROM content WHERE content.id = revision.content);
-- The revision's, as it was when the run was created.
ALTER TABLE run ADD COLUMN sha256 BLOB CHECK (length(sha256) = 32);
UPDATE run SET sha256 = (SELECT sha256 FROM revision WHERE revision.program = run.program AND revision.number = run.revision);

CREATE INDEX record_of_memory ON record (machine, epoch, number) WHERE kind = 'message' AND device = 'memory';
