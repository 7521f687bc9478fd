#!/bin/sh
# The layer rule as far as include paths can't enforce it: tests/check-layers.sh VOCABULARY...
# drivers sees a few headers of src (VOCABULARY); src sees no system header that has a clock, a heap
# or a file behind it; nobody climbs out of the include path.
bad=0
complain() {
  echo "layers: $1"
  bad=1
}

vocabulary=" $* "
for header in $(sed -n 's/^#include "\(.*\)\.h"/\1/p' drivers/*.[ch] | sort -u); do
  [ -f "drivers/$header.h" ] && continue
  case "$vocabulary" in
  *" $header "*) ;;
  *) complain "drivers must not include $header.h: $(grep -l "\"$header.h\"" drivers/*.[ch] | xargs)" ;;
  esac
done

system='arm_neon|assert|float|immintrin|limits|math|stdbool|stddef|stdint|string'
if grep -nE '^#include <' src/*.[ch] | grep -vE "<($system)\.h>"; then
  complain "src must not include these system headers"
fi
if grep -nE '^#include "[^"]*/' src/*.[ch] drivers/*.[ch] ui/*.[ch]; then
  complain "an include names a file of its own layers, without a path"
fi
exit $bad
