(expect TEK0304 2:0) %
G04
