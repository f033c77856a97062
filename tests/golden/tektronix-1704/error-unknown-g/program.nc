(expect TEK0107 2:0) %
G41
