O0425
g00 x1. (small)
y2.
m30
