(expect TEK0108 2:4) %
G00G91
