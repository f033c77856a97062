(expect CEN0550 3:1)
P1=1
G[P1] X1
