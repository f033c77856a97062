(expect CEN0601 2:0)
WEND
