-- What v18.sql has more than v17.sql: which setup is in a control.
INSERT INTO loaded_setup VALUES('m1',1,'anna',1700000000000018);
