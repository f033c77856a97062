-- What v12.sql has more than v11.sql: the rules of a machine, an applied and a pending correction.
INSERT INTO offset_rules VALUES ('m1', 1, '[[rule]]' || char(10), 'quality', 1700000000000000);
INSERT INTO offset_proposal (machine, rule, target, unit, old_value, new_value, base, state, used, left_out, mean, first, last, reasons, created_us, decided_us, who, setup)
  VALUES ('m1', 'bore', 'T3.wear.X', 'mm', 0.0, -0.02, 1, 'applied', 5, 1, 0.02, 1, 1, '["mean 0.02"]', 1700000000000000, 1700000001000000, 'quality', 2);
INSERT INTO offset_proposal (machine, rule, target, unit, old_value, new_value, base, used, left_out, mean, first, last, reasons, created_us)
  VALUES ('m1', 'bore', 'T3.wear.X', 'mm', -0.02, -0.03, 2, 5, 0, 0.01, 1, 1, '["mean 0.01"]', 1700000002000000);
