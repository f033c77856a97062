(expect CEN0200 2:11)
P1=1/[2-2]
