# make              build kitsuke (build/release/kitsuke)
# make run          install what is missing, build, and run the main job
# make check        install what is missing, build, and pass the tests and the layer checks
# make bench        microseconds and work units per stage of a frame (tests/bench_frame.c), and of parts
# make bench-peers  kitsuke beside Bullet, Embree and CGAL; installs them; writes build/bench-peers.json
# make fuzz         every fuzzer for FUZZ_SECONDS (10) each
# make hash-matrix  the bundled tape's hash over compilers, levels, sanitizers and aarch64
# make tremor       the bundled tape with 20 trembling hands
# make matrix       every real garment on every real body, judged and drawn (tests/matrix.sh)
# make check-kernel the program in a user-mode Linux with a real hidraw, gpiochip and display; builds that
#                   kernel once (tests/kernel/build.sh); CASES="NAME ..." runs some only
# make tapes        the hand writes the bundled tapes anew (tests/hand.c)
# make sheet        pictures of the station's states in both languages, and all on build/sheet/sheet.png
# make examples     pictures of the paper's own examples, before and after, under build/examples
# make format       clang-format everything; format-check only looks
# make clean        remove build/
#
# config=  release (default), debug, sanitize, thread, coverage, fuzz (with CC=clang)
# werror=1 warnings are errors;  CC=clang;  build=DIR instead of build;  V=1 shows whole commands

config ?= release
build ?= build
B := $(build)/$(config)
FUZZ_SECONDS ?= 10

# The bundled visits; tests/hand.c writes them.
TAPE  := tests/tapes/tshirt.hid
TAPES := tshirt sleeves skirt poncho askew

# A folder may include only what stands on its line. This is the layer rule.
INC_src           := -iquote src
INC_drivers       := -iquote src -iquote drivers
INC_ui            := -iquote src -iquote ui
INC_firmware-host := -iquote src -iquote drivers -iquote ui -iquote firmware-host
INC_tests         := $(INC_firmware-host) -iquote tests

# Of src, drivers may include these alone: a vocabulary, not the model.
DRIVER_VOCABULARY := arena base bone edit input journal limits mark pattern triangle vec

# The core may ask the C library for these and for nothing else: no heap, no clock, no files, no
# libm function whose last bit differs between systems.
CORE_IMPORTS := memcpy memset memmove memcmp strlen sqrtf must_fail

CFLAGS_common   := -std=c17 -D_GNU_SOURCE -g -MMD -MP -ffp-contract=off -fno-math-errno -fno-strict-aliasing \
                   -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wstrict-prototypes \
                   -Wmissing-prototypes -Wvla -Wdouble-promotion -Wimplicit-fallthrough \
                   $(if $(werror),-Werror)
CFLAGS_debug    := -O0
CFLAGS_release  := -O2
CFLAGS_sanitize := -O2 -fsanitize=address,undefined -fno-sanitize-recover=all
CFLAGS_thread   := -O1 -fsanitize=thread
CFLAGS_coverage := -O0 --coverage
CFLAGS_fuzz     := -O1 -fsanitize=fuzzer-no-link,address,undefined -fno-sanitize-recover=all
FLAGS           := $(CFLAGS_common) $(CFLAGS_$(config)) $(CFLAGS)

comma := ,
sources = $(wildcard $(1)/*.c)
objects = $(patsubst %.c,$(B)/%.o,$(1))

# The pure part: what turns a tape into a state hash. It needs a C library and no package at all.
CORE := $(call sources,src)
PURE := $(CORE) $(wildcard drivers/tape*.c) \
        $(wildcard drivers/pen*.c drivers/plane_map.c) \
        $(filter-out ui/draw%,$(call sources,ui)) \
        $(wildcard firmware-host/kiosk*.c firmware-host/must.c firmware-host/threads.c)

MAIN  := firmware-host/main.c
LIB   := $(filter-out $(MAIN),$(foreach d,src drivers ui firmware-host,$(call sources,$d)))
TESTS := $(patsubst %.c,$(B)/%,$(wildcard tests/test_*.c))
TEST_SCRIPTS := $(wildcard tests/test_*.sh)
# Whole visits with sanitizers are the hash matrix's part.
ifeq ($(config),sanitize)
TESTS := $(filter-out $(addprefix $(B)/tests/,test_tapes test_drag_ways test_layers test_examples),$(TESTS))
TEST_SCRIPTS := $(filter-out $(addprefix tests/test_,replay.sh real_garments.sh wrap_marks.sh),$(TEST_SCRIPTS))
endif
BENCH := $(patsubst %.c,$(B)/%,$(wildcard tests/bench_*.c))
FUZZ  := $(patsubst %.c,$(B)/%,$(wildcard tests/fuzz_*.c))
TOOLS := $(patsubst %.c,$(B)/%,$(wildcard tests/hand.c tests/measure_sections.c tests/drape.c tests/contact.c tests/sheet.c))
KERNEL_TOOLS := $(patsubst %.c,$(B)/%,$(filter-out %_common.c,$(call sources,tests/kernel)))
ALL   := $(LIB) $(MAIN) $(call sources,tests) $(call sources,tests/kernel)
DATA  := $(wildcard tests/tapes/* tests/journals/*)

PACKAGES := cairo pangocairo jansson zlib libqrencode hidapi-hidraw libusb-1.0 libgpiod libdrm gbm egl glesv2 sdl2 libpng libudev libwacom
# Asked once, and only when something is to be compiled.
PACKAGE_CFLAGS = $(eval PACKAGE_CFLAGS := $(shell pkg-config --cflags $(PACKAGES)))$(PACKAGE_CFLAGS)
PACKAGE_LIBS   = $(eval PACKAGE_LIBS := $(shell pkg-config --libs $(PACKAGES)))$(PACKAGE_LIBS)
CLANG_FORMAT  ?= clang-format

# All processors, unless the caller said how many.
AT_ONCE = $(if $(filter -j%,$(MAKEFLAGS)),,-j$(shell nproc))
SUBMAKE = +@$(MAKE) --no-print-directory $(AT_ONCE)
# A short line per file instead of the command, unless V=1.
SHORT = $(if $(V),,@echo '  $(1)' '$(patsubst $(B)/%,%,$(or $(2),$@))';)

all: $(B)/kitsuke

$(B)/kitsuke: $(call objects,$(MAIN)) $(B)/kitsuke.a
$(B)/tests/test_display_kms $(B)/tests/test_display_screens: $(B)/tests/fake_card.o
$(B)/tests/test_editor: $(B)/tests/hand_motion.o $(B)/tests/hand_visit.o
$(TESTS) $(BENCH) $(FUZZ): %: %.o $(B)/kitsuke.a
.SECONDEXPANSION:
$(TOOLS): %: %.o $$(call objects,$$(wildcard $$(subst $(B)/,,$$@)_*.c)) $(B)/kitsuke.a
$(KERNEL_TOOLS): %: %.o $(call objects,tests/kernel/play_common.c) $(B)/kitsuke.a
$(FUZZ): LINK := -fsanitize=fuzzer
# Calls that a program of the tests wants to see pass: the linker sends our calls of f to __wrap_f.
$(B)/tests/bench_frame: LINK := -Wl,--wrap=drag_move,--wrap=cloth_self
$(B)/tests/test_display_turn: LINK := -Wl,--wrap=display_context_lost
$(B)/tests/test_latency: LINK := -Wl,--wrap=read
$(B)/tests/test_take_home: LINK := $(patsubst %,-Wl$(comma)--wrap=%,open write fsync)
$(B)/tests/test_allocation: LINK := $(patsubst %,-Wl$(comma)--wrap=%,malloc calloc realloc \
                             aligned_alloc posix_memalign strdup strndup)

$(B)/kitsuke $(TESTS) $(BENCH) $(FUZZ) $(TOOLS) $(KERNEL_TOOLS):
	$(call SHORT,link)$(CC) $(FLAGS) $^ $(LINK) $(LDFLAGS) -Wl,--as-needed $(PACKAGE_LIBS) -lm -lpthread -o $@

$(B)/kitsuke.a: $(call objects,$(LIB))
	@rm -f $@
	$(call SHORT,pack)$(AR) rcs $@ $^

# tape -> pen -> face -> session -> hash. Linked statically, so that a cross-built one runs under
# qemu-user without a foreign system beside it.
STATIC = $(if $(findstring sanitize,$(FLAGS)),,-static)
$(B)/tests/replay_hash: $(call objects,tests/replay_hash.c $(PURE))
	$(call SHORT,link)$(CC) $(FLAGS) $^ $(LDFLAGS) $(STATIC) -lm -lpthread -o $@

# Who made a folder's objects, and how: they are made anew by another compiler or with other flags.
MADE_BY = $(shell LC_ALL=C $(CC) -v 2>&1 | grep -E '^Target| version [0-9]') $(filter-out -Werror,$(FLAGS))
$(B)/made-by: FORCE
	@mkdir -p $(@D)
	@echo '$(MADE_BY)' | cmp -s - $@ || echo '$(MADE_BY)' >$@

# The pure part is compiled without a single package on its include path.
$(call objects,$(PURE) tests/replay_hash.c): PACKAGE_CFLAGS :=
$(B)/%.o: %.c Makefile $(B)/made-by
	@mkdir -p $(@D)
	$(call SHORT,cc,$<)$(CC) $(INC_$(firstword $(subst /, ,$<))) $(FLAGS) $(PACKAGE_CFLAGS) -c $< -o $@

run:
	@firmware-host/setup run
	$(SUBMAKE) all
	$(B)/kitsuke --else-replay $(TAPE) --out out $(ARGS)

check:
	@firmware-host/setup check
	$(SUBMAKE) -k tests check-layers check-imports; status=$$?; \
	  tests/check-summary.sh $(STAMPS) && exit $$status

# tests/check-test.sh says what passing, failing and skipping mean. Those that take longest begin
# first, so that no processor waits for the last.
STAMPS = $(TESTS:=.ok) $(patsubst %,$(B)/%.ok,$(TEST_SCRIPTS))
LONG  := layers wrap examples tapes real_garments.sh drag_ways commands.sh unfold start.sh wrap_marks.sh \
         pen_descriptor allocation
tests: $(foreach name,$(LONG),$(filter %/test_$(name).ok,$(STAMPS))) $(STAMPS)
$(TESTS:=.ok): %.ok: % $(DATA) tests/check-test.sh
	@tests/check-test.sh $@ ./$<
$(B)/tests/%.sh.ok: tests/%.sh $(B)/kitsuke $(DATA) tests/check-test.sh
	@KITSUKE=$(B)/kitsuke tests/check-test.sh $@ $<
$(STAMPS): | $(TOOLS)

check-layers:
	@tests/check-layers.sh $(DRIVER_VOCABULARY)

# Sanitizers and coverage call their own run-time library, which says nothing about the core.
check-imports: $(call objects,$(CORE))
ifneq ($(filter $(config),debug release),)
	@tests/check-imports.sh '$(CORE_IMPORTS)' $^
endif

# Everything that links, tests included, without running it.
programs: $(TESTS) $(BENCH) $(TOOLS) $(KERNEL_TOOLS)

bench: $(BENCH) $(TOOLS)
	@for bench in $(BENCH); do $$bench || exit; done

# kitsuke beside its peers, on garments of up to 50,000 vertices: a table, and bench-peers.json.
bench-peers:
	@firmware-host/setup peers
	$(SUBMAKE) build=$(build)/peers CFLAGS='$(CFLAGS) -DGARMENT_VERTICES_MAX=53248' peers
	$(build)/peers/$(config)/tests/peers $(ARGS) $(build)/bench-peers.json

PEERS := $(call objects,$(wildcard tests/peers*.c))
PEER_OBJECTS := $(patsubst %.cpp,$(B)/%.o,$(wildcard tests/peer_*.cpp))
PEER_LIBS = $(shell pkg-config --libs bullet) $(patsubst /usr/include/embree%,-lembree%,$(wildcard /usr/include/embree[34])) -lgmp
peers: $(B)/tests/peers
$(B)/tests/peers: LINK := -Wl,--wrap=cloth_self
$(B)/tests/peers: $(PEERS) $(PEER_OBJECTS) $(B)/kitsuke.a
	$(call SHORT,link)$(CXX) $^ $(LINK) $(LDFLAGS) -Wl,--as-needed $(PEER_LIBS) -lm -o $@
$(B)/tests/%.o: tests/%.cpp Makefile
	@mkdir -p $(@D)
	$(call SHORT,c++,$<)$(CXX) $(INC_tests) -O2 -DNDEBUG -MMD -MP $(shell pkg-config --cflags bullet) -c $< -o $@

fuzz:
	$(SUBMAKE) config=fuzz CC=clang fuzzers
	@tests/check-fuzz.sh $(build)/fuzz $(FUZZ_SECONDS)
fuzzers: $(FUZZ)

hash-matrix:
	@MAKE='$(MAKE)' tests/check-hash.sh $(build)

tremor: $(B)/kitsuke
	@KITSUKE=$(B)/kitsuke tests/check-tremor.sh

matrix: $(B)/kitsuke $(B)/tests/drape $(B)/tests/contact
	@KITSUKE=$(B)/kitsuke TOOLS=$(B)/tests tests/matrix.sh $(build)/matrix

check-kernel:
	@firmware-host/setup kernel
	$(SUBMAKE) $(B)/kitsuke $(KERNEL_TOOLS)
	@KITSUKE=$(B)/kitsuke TOOLS=$(B)/tests/kernel tests/kernel/run.sh $(build)/kernel $(CASES)

tapes: $(B)/tests/hand
	@for visit in $(TAPES); do $< $$visit tests/tapes/$$visit.hid || exit; done

sheet: $(B)/tests/sheet
	@$< $(build)/sheet

examples: $(B)/kitsuke
	@KITSUKE=$(B)/kitsuke tests/examples.sh $(build)/examples

format:
	$(CLANG_FORMAT) -i $(wildcard */*.[ch] tests/kernel/*.[ch])

format-check:
	@$(CLANG_FORMAT) --dry-run -Werror $(wildcard */*.[ch] tests/kernel/*.[ch])

help:
	@sed -n 's/^# \{0,1\}//p;/^$$/q' Makefile

clean:
	rm -rf $(build)

.PHONY: all run check tests programs check-layers check-imports bench bench-peers peers fuzz fuzzers hash-matrix tremor \
        matrix check-kernel tapes sheet examples format format-check help clean FORCE
.SECONDARY:
-include $(patsubst %.c,$(B)/%.d,$(ALL)) $(PEER_OBJECTS:.o=.d)
