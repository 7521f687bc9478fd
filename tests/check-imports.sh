#!/bin/sh
# What object files ask of the outside: tests/check-imports.sh 'ALLOWED NAMES' OBJECT...
allowed=$1
shift
nm -g "$@" | awk -v ok="$allowed" '
  BEGIN { count = split(ok, name); for (i = 1; i <= count; i++) allowed[name[i]] }
  NF == 3 { own[$3] }
  NF == 2 && $1 == "U" { used[$2] }
  END {
    for (s in used)
      if (!(s in own) && !(s in allowed)) { print "src must not call " s; bad = 1 }
    exit bad
  }'
