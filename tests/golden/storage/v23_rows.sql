-- What v23.sql has more than v22.sql: a test run that was cut off.
CREATE TEMP TABLE cut AS SELECT * FROM run WHERE id = 'r3';
UPDATE cut SET number = 4, id = 'r4', state = 'interrupted', reason = 'the server stopped', is_test = 1;
INSERT INTO run SELECT * FROM cut;
DROP TABLE cut;
