# make            build kitsuke (build/release/kitsuke)
# make run        build, install what is missing, and run the main job
# make check      build and pass the tests
# make config=…   release (default), debug, sanitize, coverage, fuzz (with CC=clang)
# make format     clang-format everything
# make clean

config ?= release
build ?= build
B := $(build)/$(config)

# A folder may include only what stands on its line. This is the layer rule.
INC_src           := -iquote src
INC_drivers       := -iquote src -iquote drivers
INC_ui            := -iquote src -iquote ui
INC_firmware-host := -iquote src -iquote drivers -iquote ui -iquote firmware-host
INC_tests         := $(INC_firmware-host) -iquote tests

CFLAGS_common   := -std=c17 -D_GNU_SOURCE -g -MMD -MP -ffp-contract=off -fno-strict-aliasing \
                   -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wstrict-prototypes \
                   -Wmissing-prototypes -Wvla -Wdouble-promotion -Wimplicit-fallthrough \
                   $(if $(werror),-Werror)
CFLAGS_debug    := -O0
CFLAGS_release  := -O2
CFLAGS_sanitize := -O1 -fsanitize=address,undefined -fno-sanitize-recover=all
CFLAGS_coverage := -O0 --coverage
CFLAGS_fuzz     := -O1 -fsanitize=fuzzer-no-link,address,undefined -fno-sanitize-recover=all
FLAGS           := $(CFLAGS_common) $(CFLAGS_$(config)) $(CFLAGS)

sources = $(wildcard $(1)/*.c)
objects = $(patsubst %.c,$(B)/%.o,$(1))

CORE     := $(call sources,src)
LIB      := $(CORE) $(filter-out firmware-host/main.c,$(foreach d,drivers ui firmware-host,$(call sources,$d)))
TESTS    := $(patsubst %.c,$(B)/%,$(wildcard tests/test_*.c))
BENCH    := $(patsubst %.c,$(B)/%,$(wildcard tests/bench_*.c))
FUZZ     := $(patsubst %.c,$(B)/%,$(wildcard tests/fuzz_*.c))
TOOLS    := $(B)/tests/hand
ALL      := $(LIB) firmware-host/main.c $(call sources,tests)

PACKAGES := cairo pangocairo jansson hidapi-hidraw libusb-1.0 libgpiod libdrm gbm egl glesv2 sdl2 libpng libudev
PACKAGE_CFLAGS = $(shell pkg-config --cflags $(PACKAGES))
PACKAGE_LIBS   = $(shell pkg-config --libs $(PACKAGES))

all: $(B)/kitsuke

$(B)/kitsuke: $(call objects,firmware-host/main.c) $(B)/kitsuke.a
$(TESTS) $(BENCH) $(FUZZ): %: %.o $(B)/kitsuke.a
$(FUZZ): LINK := -fsanitize=fuzzer

$(B)/kitsuke $(TESTS) $(BENCH) $(FUZZ):
	$(CC) $(FLAGS) $^ $(LINK) $(LDFLAGS) $(PACKAGE_LIBS) -lm -lpthread -o $@

$(B)/kitsuke.a: $(call objects,$(LIB))
	@rm -f $@
	$(AR) rcs $@ $^

# The core is compiled without a single package on its include path.
$(call objects,$(CORE)): PACKAGE_CFLAGS :=
$(B)/%.o: %.c Makefile
	@mkdir -p $(@D)
	$(CC) $(INC_$(firstword $(subst /, ,$<))) $(FLAGS) $(PACKAGE_CFLAGS) -c $< -o $@

# A test prints nothing when it passes; exit status 77 is a skip with its reason on stdout.
$(B)/%.ok: $(B)/%
	./$<
	@touch $@

check: $(TESTS:=.ok)
	@echo "all checks pass ($(config))"

format:
	clang-format -i $(wildcard */*.[ch])

clean:
	rm -rf build

.PHONY: all check format clean
.SECONDARY:
-include $(patsubst %.c,$(B)/%.d,$(ALL))
