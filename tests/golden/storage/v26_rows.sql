-- What v26.sql has more than v25.sql: a machine that was removed.
INSERT INTO machine (name, control, description, gateway_version, epoch, first_seen_us, last_seen_us, removed_us) VALUES ('m9', 'centurion', '', '', 1, 1, 2, 3);
