-- What v21.sql has more than v20.sql: a test run.
CREATE TEMP TABLE tested AS SELECT * FROM run WHERE id = 'r1';
UPDATE tested SET number = 3, id = 'r3', state = 'tested', executed = 0, line = 0, reason = 'test run: 2 blocks', outputs = 0, job = NULL, motion_seconds = NULL, path_mm = NULL;
INSERT INTO run SELECT * FROM tested;
DROP TABLE tested;
