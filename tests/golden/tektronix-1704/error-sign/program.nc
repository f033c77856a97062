(expect TEK0106 2:2) %
F-10
