(expect CEN0608 2:0)
M98
