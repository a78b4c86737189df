# ramify: `make help` lists the targets. Every target installs the Debian packages it needs when they are missing.

# The one list of Debian packages. BUILD: to compile and run. CHECK: only for lint, format, sanitize and bench. PEERS: other
# programs that tests hold our files against, as COMMAND:PACKAGE. FUZZ: only for fuzz. CLUSTER: only for
# test-cluster. SAME_BITS: only for same-bits-builds.
BUILD_PACKAGES = gcc g++ libc6-dev pkg-config libembree-dev libosd-dev libopenvdb-dev libboost-dev libopenimageio-dev \
                 libopenexr-dev libpng-dev libjpeg-dev libopencolorio-dev libassimp-dev libyaml-dev libtbb-dev libnlopt-dev libseccomp-dev \
                 libcmocka-dev libgdal-dev ffmpeg
CHECK_PACKAGES = clang-format clang-tidy cppcheck libomp-14-dev
FUZZ_PACKAGES  = clang libclang-rt-14-dev
PEER_COMMANDS  = povray:povray povray:povray-includes blender:blender node:nodejs npm:npm chromium:chromium mandoc:mandoc \
                 oiiotool:openimageio-tools gdalinfo:gdal-bin assimp:assimp-utils zsh:zsh
SAME_BITS_PACKAGES = clang libomp-14-dev
CLUSTER_PACKAGES = slurm-wlm munge

, := ,
VERSION := $(shell sed -n 's/^\#define RAMIFY_VERSION "\(.*\)"/\1/p' src/ramify.h)
SONAME  := libramify.so.1# counts up when programs must be compiled anew
# The commit that is compiled: that of this folder's repository, or what `make dist` wrote into an archive of it.
COMMIT  := $(or $(if $(wildcard .git),$(shell git describe --always --abbrev=12 --dirty --exclude='*' 2>/dev/null)),$(shell cat .commit 2>/dev/null),unknown)
CONFIG ?= release
ARCH   ?= native
PREFIX ?= /usr/local
OUT    ?= build$(if $(filter-out release,$(CONFIG)),/$(if $(filter variant,$(CONFIG)),same-bits/$(VARIANT),$(CONFIG)))
OBJ    := $(OUT)/obj

# Same bits for growth everywhere: no contraction into FMA, no reassociation. (-fno-math-errno and -fno-trapping-math
# change no value; they let sqrtf become one instruction.) GCC 12 fuses the products of complex numbers that it vectorizes in
# spite of the first: straight code is vectorized in the path tracer alone, and the Fourier transform not at all.
OPT      := $(if $(filter sanitize,$(CONFIG)),-O1 -fsanitize=address$(,)undefined -fno-omit-frame-pointer,-O3)
ifeq ($(CONFIG),fuzz) # compiled by clang, without OpenMP: an input is read by one thread
CC       := clang
CXX      := clang++
OPT      := -O2 -fsanitize=fuzzer-no-link,address,undefined -fno-sanitize-recover=undefined -fno-omit-frame-pointer -w
endif
ifeq ($(CONFIG),threads) # compiled by clang, whose OpenMP tells ThreadSanitizer (by Archer) what its barriers order
CC       := clang
CXX      := clang++
OPT      := -O1 -fsanitize=thread -fno-omit-frame-pointer -w
endif
ifeq ($(CONFIG),variant) # VARIANT: COMPILER-OPTIMIZATION-PROCESSOR, as clang-O1-avx512; for same-bits-builds
OF       := $(subst -, ,$(VARIANT))
CC       := $(word 1,$(OF))
CXX      := $(CC:gcc=g)++
OPT      := -$(word 2,$(OF)) -w
ARCH     := $(if $(filter avx512,$(word 3,$(OF))),x86-64-v4,x86-64-v3)
endif
# What makes a flaw of memory harder to use, in what is installed; sanitizers have their own ways.
HARDEN   := $(if $(filter sanitize fuzz threads,$(CONFIG)),,-fstack-protector-strong -U_FORTIFY_SOURCE -D_FORTIFY_SOURCE=3)
# No path of this folder gets into what is compiled, so that every folder makes the same bytes.
OPENMP   := $(if $(filter fuzz,$(CONFIG)),,-fopenmp)
# What debuggers read takes a fifth of the time to compile, and nobody looks at it in CI. It changes no instruction.
UNREAD   := $(if $(filter true,$(CI)),$(filter release,$(CONFIG)))
DEBUG    := $(if $(UNREAD),-g0,-g)
NO_PATHS := -ffile-prefix-map=$(CURDIR)=.
COMMON   := $(DEBUG) $(OPT) $(NO_PATHS) -march=$(ARCH) -ffp-contract=off -fno-tree-slp-vectorize -fno-math-errno -fno-trapping-math $(OPENMP) -fPIC -MMD -MP -Isrc \
            -Wall -Wextra -Werror
CFLAGS   := -std=c17 -D_GNU_SOURCE $(COMMON) -Wshadow -Wconversion -Wstrict-prototypes -Wmissing-prototypes
CXXFLAGS := -std=c++17 $(COMMON)
LDLIBS   := -lembree3 -losdCPU -lassimp -lyaml -lnlopt -lseccomp -lstdc++ -lm
LDFLAGS  := -Wl,-z,relro,-z,now,-z,noexecstack -fopenmp $(if $(filter sanitize,$(CONFIG)),-fsanitize=address$(,)undefined) $(if $(filter threads,$(CONFIG)),-fsanitize=thread)

# The path tracer's small functions call each other across files: inlining them while linking makes it 1.1 x faster.
LTO := $(if $(filter sanitize fuzz variant threads,$(CONFIG)),,-flto=auto -ffat-lto-objects)
# What is kept for linking names the folder whatever the options say: let it be called the same everywhere.
$(OBJ)/render/%.c.o $(OUT)/ramify: private SAME_LTO := $(if $(LTO),PWD=/proc/self/cwd )
$(OBJ)/render/%.c.o: CFLAGS += $(LTO) -ftree-slp-vectorize
$(OBJ)/base/fft.c.o: CFLAGS += -fno-tree-vectorize
$(OUT)/ramify $(OUT)/libramify.so $(OUT)/tests/bench/%: private LDFLAGS += $(LTO)
# OpenVDB's templates take a third less time to compile with lines alone to debug by. What reads and writes files waits for the
# disk: its templates take a third less again with little optimization.
$(OBJ)/shape/vdb_%.cpp.o: CXXFLAGS += $(if $(UNREAD),,-g1)
$(OBJ)/shape/vdb_read.cpp.o $(OBJ)/shape/vdb_grid_file.cpp.o: CXXFLAGS += $(if $(filter release,$(CONFIG)),-O1)
# TBB's headers cast addresses that are none.
$(OBJ)/shape/vdb_%.cpp.o: CXXFLAGS += $(if $(filter fuzz,$(CONFIG)),-fno-sanitize=alignment)

# What needs libraries that take long to load (OpenImageIO brings 240 others) lies in plug-ins, ramify-NAME.so, which are
# loaded when first used (base/plugin.h). Their sources and libraries:
PLUGINS      := oiio write vdb ocio gdal
PLUGIN_oiio  := image/decode.cpp
LDLIBS_oiio  := -lOpenImageIO -lOpenImageIO_Util -lstdc++ -lm
PLUGIN_write := image/encode.c image/encode_png.c image/encode_jpeg.c image/encode_exr.cpp image/encoded.c
LDLIBS_write := -lpng -ljpeg -lOpenEXR -lImath -lstdc++ -lm
PLUGIN_vdb   := shape/vdb_level_set.cpp shape/vdb_grid_file.cpp shape/vdb_read.cpp shape/spare_memory.cpp
LDLIBS_vdb   := -lopenvdb -lImath -ltbb -lstdc++ -lm
PLUGIN_ocio  := image/ocio_view.cpp
LDLIBS_ocio  := -lOpenColorIO -lstdc++ -lm
PLUGIN_gdal  := land/survey_gdal.cpp land/geotiff_gdal.cpp
LDLIBS_gdal  := -lgdal -lstdc++ -lm
# OpenEXR's headers include Imath's by their bare names.
$(OBJ)/image/encode_exr.cpp.o: CXXFLAGS += $(shell pkg-config --cflags-only-I Imath)
PLUGIN_FILES := $(PLUGINS:%=$(OUT)/ramify-%.so)
# Where programs look for plug-ins: beside them in build/, or in lib/ramify/.
RUNPATH         = -Wl,--enable-new-dtags,-rpath,'$(1)'
RUNPATH_PROGRAM = $(call RUNPATH,$$ORIGIN:$$ORIGIN/../lib/ramify)
RUNPATH_LIBRARY = $(call RUNPATH,$$ORIGIN:$$ORIGIN/ramify)
RUNPATH_TEST    = $(call RUNPATH,$$ORIGIN/../..)

SOURCES   := $(sort $(wildcard src/*.c $(foreach d,src/* src/*/*,$d/*.c $d/*.cpp)))
COMMANDS  := render turntable grow measure fit export merge develop batch replay compare golden info species schema completion help
MANUAL    := $(OUT)/man/ramify.1 $(COMMANDS:%=$(OUT)/man/ramify-%.1) $(OUT)/completion/ramify $(OUT)/completion/_ramify
# Text files that become arrays of the program: report.css is report_css[].
EMBEDDED  := $(sort $(foreach e,css html js bash zsh sh,$(wildcard src/*/*.$e src/*/*/*.$e)))
SOURCES   += $(EMBEDDED)
LIB_OBJ   := $(patsubst src/%,$(OBJ)/%.o,$(filter-out src/cli/% $(foreach p,$(PLUGINS),$(PLUGIN_$p:%=src/%)),$(SOURCES)))
PLUGIN_OBJ := $(foreach p,$(PLUGINS),$(PLUGIN_$p:%=$(OBJ)/%.o))
SPECIES   := $(sort $(wildcard scenes/species/*.yaml))
LIB_OBJ   += $(OBJ)/species_library.o
CLI_OBJ   := $(patsubst src/%,$(OBJ)/%.o,$(filter src/cli/%,$(SOURCES))) $(OBJ)/commit.o
TESTS     := $(sort $(wildcard tests/*/test_*.c))
TEST_BIN  := $(patsubst tests/%.c,$(OUT)/tests/%,$(TESTS))
FUZZ_TARGETS := scene set rules swc heights mesh picture vdb
BENCHES   := $(sort $(wildcard tests/bench/*.c))
BENCH_BIN := $(patsubst tests/%.c,$(OUT)/tests/%,$(BENCHES))
FORMATTED := $(wildcard src/*.[ch] $(foreach d,src/* src/*/*,$d/*.[ch] $d/*.cpp) tests/*.h tests/*/*.[ch] docs/examples/*.c)

.PHONY: dist deb deb-check reproduce all demo cross-check docs test test-cluster peers bench bench-renderers sanitize lint format format-check install uninstall clean help packages check-packages cluster-packages
.PHONY: fuzz faults estimates random-scenes same-bits-builds soak tsan valgrind
.DEFAULT_GOAL := all
.DELETE_ON_ERROR:

# Plugins first: a file of theirs takes a minute.
all: packages ## build build/ramify, build/libramify.a and build/libramify.so
	@$(MAKE) --no-print-directory -j$$(nproc) $(PLUGIN_FILES) $(OUT)/ramify $(OUT)/libramify.a $(OUT)/libramify.so $(MANUAL)

demo: all ## render the oak of scenes/oak.yaml to build/oak.png (and .exr)
	$(OUT)/ramify render scenes/oak.yaml -o $(OUT)/oak.png

# In CI the other programs are fetched while this compiles.
test: $(if $(filter true,$(CI)),packages,all) ## build and run every test; the last line counts them
ifeq ($(CI),true)
	@$(MAKE) --no-print-directory peers & peers=$$!; $(MAKE) --no-print-directory all; built=$$?; wait $$peers && exit $$built
endif
	@$(MAKE) --no-print-directory -j$$(nproc) $(TEST_BIN) $(OUT)/tests/cross/compare
	@RAMIFY=$(OUT)/ramify tests/run $(TEST_BIN)

test-cluster: all cluster-packages ## run ramify batch on a real Slurm with two nodes on this machine, which die; as root
	@RAMIFY=$(OUT)/ramify tests/cluster/run

cross-check: all ## render the scenes of tests/cross in POV-Ray too and compare: build/cross-check/index.html
	@$(MAKE) --no-print-directory $(OUT)/tests/cross/compare
	@RAMIFY=$(abspath $(OUT)/ramify) COMPARE=$(abspath $(OUT)/tests/cross/compare) tests/cross/run $(OUT)/cross-check

docs: all ## write docs/scene.md anew from the tables of scene files
	$(OUT)/ramify schema --markdown > docs/scene.md

peers: ## install the outside programs that tests compare with: POV-Ray, Blender, Node.js, Chromium, USD, ...
	$(call need,$(foreach p,$(PEER_COMMANDS),$(if $(shell command -v $(firstword $(subst :, ,$p))),,$(lastword $(subst :, ,$p)))) \
	    $(if $(shell python3 -c 'import ensurepip' 2>/dev/null && echo yes),,python3-venv) \
	    $(if $(wildcard /usr/lib/python3/dist-packages/numpy),,python3-numpy))
	@tests/peers/install build/peers

bench: all ## print the figures of speed, as ratios to yardsticks measured in the same run
	@$(MAKE) --no-print-directory -j$$(nproc) $(BENCH_BIN)
	@tests/bench/run $(OUT)

bench-renderers: all ## compare with Cycles and Mitsuba 3 from PyPI: SCENES=s1,s2 SKY=FILE.hdr REPEATS=N SIZE=WxH JSON=FILE PICTURES=FILE
	@tests/bench/renderers/run $(OUT) $(if $(SCENES),--scenes $(SCENES)) $(if $(SKY),--sky "$(SKY)") \
	    $(if $(REPEATS),--repeats $(REPEATS)) $(if $(SIZE),--size $(SIZE)) $(if $(JSON),--json "$(JSON)") \
	    $(if $(PICTURES),--pictures "$(PICTURES)")

random-scenes: all ## render COUNT=1000 random scenes: each gives a picture, the same for any number of threads, or one error
	@OMP_WAIT_POLICY=passive python3 tests/fuzz/random_scenes.py $(OUT)/ramify $(or $(COUNT),1000) $(or $(SEED),1) build/random-scenes

# Growth and geometry are the same in all of these; what only other commands need is not built.
VARIANTS := $(foreach c,gcc clang,$(foreach o,O1 O3,$(foreach a,avx2 avx512,$c-$o-$a)))
same-bits-builds: all ## compare growth and meshes of gcc and clang, -O1 and -O3, AVX2 and AVX-512, 1 to 16 threads: VARIANTS="gcc-O1-avx2 ..."
	$(call need,$(SAME_BITS_PACKAGES))
	@set -e; for variant in $(VARIANTS); do \
	    $(MAKE) --no-print-directory -j$$(nproc) CONFIG=variant VARIANT=$$variant 'PLUGIN_FILES=$$(OUT)/ramify-vdb.so' \
	        build/same-bits/$$variant/tests/bits/print_bits; done
	@tests/bits/run $(OUT)/ramify build/same-bits $(VARIANTS)

# Without AVX-512, which Valgrind does not know; tests that take minutes under it or trace rays are left out.
VALGRIND := build/same-bits/gcc-O1-avx2
VALGRIND_TESTS ?= base/test_base base/test_mesh outtree/test_out_tree outtree/test_swc outtree/test_murray objects/test_foliage mesh/test_curves
valgrind: packages ## run a few quick tests under Valgrind's memcheck: VALGRIND_TESTS="base/test_base ..."
	$(call need,valgrind)
	@$(MAKE) --no-print-directory -j$$(nproc) CONFIG=variant VARIANT=$(notdir $(VALGRIND)) 'PLUGIN_FILES=$$(OUT)/ramify-vdb.so' \
	    $(VALGRIND_TESTS:%=$(VALGRIND)/tests/%)
	@set -e; for test in $(VALGRIND_TESTS); do echo "  MEMCHECK $$test"; OMP_NUM_THREADS=1 valgrind -q --error-exitcode=9 --leak-check=full \
	    --errors-for-leak-kinds=definite $(VALGRIND)/tests/$$test; done

# ThreadSanitizer sees only what was compiled for it: reports whose other half lies in a library are left out.
THREAD_TESTS ?= grow/test_colonize grow/test_light grow/test_dla grow/test_venation mesh/test_height mesh/test_skin \
    render/test_clouds render/test_update render/test_emitters
ARCHER := /usr/lib/llvm-14/lib/libarcher.so
tsan: packages ## run a few tests of parallel code under ThreadSanitizer: THREAD_TESTS="grow/test_colonize ..."
	$(call need,$(SAME_BITS_PACKAGES) $(FUZZ_PACKAGES))
	@$(MAKE) --no-print-directory -j$$(nproc) CONFIG=threads PLUGIN_FILES= $(THREAD_TESTS:%=build/threads/tests/%)
	@set -e; for test in $(THREAD_TESTS); do echo "  TSAN $$test"; OMP_NUM_THREADS=4 OMP_TOOL_LIBRARIES=$(ARCHER) \
	    TSAN_OPTIONS=ignore_noninstrumented_modules=1:suppressions=tests/tsan.supp build/threads/tests/$$test; done

fuzz: ## feed random inputs to all that reads files: SECONDS=60 or RUNS=n for each of TARGETS="scene set rules swc heights mesh picture vdb"
	$(call need,$(FUZZ_PACKAGES))
	@$(MAKE) --no-print-directory CONFIG=fuzz -j$$(nproc) $(FUZZ_TARGETS:%=build/fuzz/fuzz_%)
	@tests/fuzz/run build/fuzz $(or $(SECONDS),$(if $(RUNS),0,60)) $(or $(RUNS),-1) $(or $(TARGETS),$(FUZZ_TARGETS))

soak: all ## render COUNT=500 random stills in one process, whose memory must stay flat, as many by the command, and 100 at once
	@$(MAKE) --no-print-directory $(OUT)/tests/soak/soak
	@OMP_WAIT_POLICY=passive python3 tests/soak/run.py $(OUT)/ramify $(OUT)/tests/soak/soak $(or $(COUNT),500) build/soak

estimates: all ## compare what ramify info --estimate tells with what the stills of the gallery take, small: SCENES="scenes/oak.yaml ..."
	@OMP_WAIT_POLICY=passive tests/estimates $(OUT)/ramify $(SCENES)

faults: all ## let allocations, readings, writings and starts of processes of small runs fail, one for each call stack: CASES="render ...", EVERY=1 for all calls
	@RAMIFY=$(OUT)/ramify sh tests/faults/test_faults.sh $(if $(EVERY),--all,--places) $(CASES:%=--case %)

sanitize: ## run the tests under AddressSanitizer and UndefinedBehaviorSanitizer
	@$(MAKE) --no-print-directory CONFIG=sanitize test

lint: packages check-packages format-check ## clang-tidy, cppcheck and the order of the folders; warnings are errors
	tests/layers.sh
	$(CC) $(filter-out -MMD -MP,$(CFLAGS)) -Itests -fsyntax-only $(BENCHES) # which no test builds
	cppcheck --quiet --std=c17 -j $$(nproc) --enable=warning,performance,portability --inline-suppr --error-exitcode=1 -Isrc src
	printf '%s\n' $(filter %.c,$(SOURCES)) | xargs -P $$(nproc) -n 1 sh -c \
	    'clang-tidy --quiet "$$@" -- -std=c17 -D_GNU_SOURCE -Isrc 2>/dev/null || exit 255' sh

format: check-packages ## lay the code out with clang-format
	clang-format -i $(FORMATTED)

format-check: check-packages
	@clang-format --dry-run --Werror $(FORMATTED)

# Where Debian's Python looks for modules below /usr/local, and below /usr with python3 in place of python3.11.
PYTHON_SITE ?= lib/$(shell python3 -c 'import sys; print("python%d.%d" % sys.version_info[:2])' 2>/dev/null || echo python3)/dist-packages
# What `make install` puts below PREFIX, as FILE:PLACE:MODE; `make uninstall` takes the places away again. Only these two ask
# for PYTHON_SITE.
INSTALL  = $(OUT)/ramify:bin/ramify:755 \
           $(OUT)/libramify.a:lib/libramify.a:644 \
           $(OUT)/libramify.so:lib/libramify.so.$(VERSION):755 \
           $(foreach f,$(PLUGIN_FILES),$f:lib/ramify/$(notdir $f):755) \
           $(OUT)/ramify.pc:lib/pkgconfig/ramify.pc:644 \
           src/ramify.h:include/ramify.h:644 \
           $(foreach page,$(filter %.1,$(MANUAL)),$(page):share/man/man1/$(notdir $(page)):644) \
           $(OUT)/completion/ramify:share/bash-completion/completions/ramify:644 \
           $(OUT)/completion/_ramify:share/zsh/site-functions/_ramify:644 \
           $(foreach f,$(notdir $(wildcard src/python/ramify/*.py src/python/ramify/py.typed)),src/python/ramify/$f:$(PYTHON_SITE)/ramify/$f:644)
LINKS   := lib/$(SONAME) lib/libramify.so

install: all ramify.pc ## install command, libraries, header, manual, completions, Python module below PREFIX (/usr/local)
	@set -e; for entry in $(INSTALL); do \
	    file=$${entry%%:*}; rest=$${entry#*:}; place="$(DESTDIR)$(PREFIX)/$${rest%:*}"; \
	    echo "  INST $$place"; install -D -m "$${rest##*:}" "$$file" "$$place"; \
	done
	@for link in $(LINKS); do ln -sf libramify.so.$(VERSION) "$(DESTDIR)$(PREFIX)/$$link"; done
	@[ -n "$(DESTDIR)" ] || [ "$$(id -u)" != 0 ] || ldconfig # so that programs find the .so at once

uninstall: ## take away what `make install` put there
	@set -e; for entry in $(INSTALL); do \
	    rest=$${entry#*:}; rm -f "$(DESTDIR)$(PREFIX)/$${rest%:*}"; \
	done
	@for link in $(LINKS); do rm -f "$(DESTDIR)$(PREFIX)/$$link"; done
	@plugins="$(DESTDIR)$(PREFIX)/lib/ramify"; [ ! -d "$$plugins" ] || rmdir --ignore-fail-on-non-empty "$$plugins"
	@module="$(DESTDIR)$(PREFIX)/$(PYTHON_SITE)/ramify"; \
	rm -rf "$$module/__pycache__" && { [ ! -d "$$module" ] || rmdir --ignore-fail-on-non-empty "$$module"; } # else it can still be imported, empty
	@[ -n "$(DESTDIR)" ] || [ "$$(id -u)" != 0 ] || ldconfig

.PHONY: ramify.pc # it holds PREFIX, which may be another one each time
ramify.pc:
	@mkdir -p $(OUT)
	@printf '%s\n' 'prefix=$(PREFIX)' 'libdir=$${prefix}/lib' 'includedir=$${prefix}/include' 'Name: ramify' \
	    'Description: grows, skins and renders branching things' 'Version: $(VERSION)' 'Libs: -L"$${libdir}" -lramify' \
	    'Libs.private: -Wl,-rpath,"$${libdir}/ramify" $(LDLIBS) -lgomp -lpthread' 'Cflags: -I"$${includedir}"' > $(OUT)/ramify.pc

# ---- releases ----

# The time of all files in archives and packages: that of the commit, or what `make dist` wrote. Asked once, not for every
# command that it is exported to.
ifndef SOURCE_DATE_EPOCH
SOURCE_DATE_EPOCH := $(or $(if $(wildcard .git),$(shell git log -1 --format=%ct 2>/dev/null)),$(shell cat .date 2>/dev/null),0)
endif
export SOURCE_DATE_EPOCH
DIST := build/ramify-$(VERSION)

dist: ## write build/ramify-VERSION.tar.gz: the sources of the commit, in the same bytes each time
	@[ -d .git ] || { echo "make dist archives a commit; this folder is no repository" >&2; exit 1; }
	@git diff --quiet HEAD || { echo "make dist archives a commit; commit the changes first" >&2; exit 1; }
	@rm -rf $(DIST) && mkdir -p $(DIST)
	@git archive HEAD | tar x -C $(DIST)
	@echo '$(COMMIT)' > $(DIST)/.commit && echo $(SOURCE_DATE_EPOCH) > $(DIST)/.date
	@cd build && LC_ALL=C tar c --sort=name --format=ustar --owner=0 --group=0 --numeric-owner --mode=go=rX,u+rw \
	    --mtime=@$(SOURCE_DATE_EPOCH) $(notdir $(DIST)) | gzip -9n > $(notdir $(DIST)).tar.gz
	@rm -rf $(DIST) && echo "  DIST $(DIST).tar.gz"

# Of the command alone. It runs on any processor of the last fifteen years, and looks for plug-ins in one place.
DEB_ARCH ?= x86-64-v2
DEB_MAKE = $(MAKE) --no-print-directory OUT=build/deb ARCH=$(DEB_ARCH) RUNPATH_PROGRAM='-Wl,--enable-new-dtags,-rpath,/usr/lib/ramify'
deb: packages ## write a Debian package, build/deb/ramify_VERSION-1_ARCHITECTURE.deb
	@+$(DEB_MAKE) -j$$(nproc) build/deb/ramify $(PLUGINS:%=build/deb/ramify-%.so)
	@+$(DEB_MAKE) $(COMMANDS:%=build/deb/man/ramify-%.1) build/deb/man/ramify.1 build/deb/completion/ramify build/deb/completion/_ramify
	@.debian/build build/deb $(VERSION)

deb-check: deb ## check the package with lintian, and install, use and remove it in a fresh Debian (as root)
	$(call need,lintian debootstrap)
	lintian --fail-on error,warning --tag-display-limit 0 build/deb/*.deb
	@.debian/try build/deb/*.deb build/deb/try

reproduce: dist ## build twice, in two folders: programs and packages must have the same bytes
	@.debian/reproduce $(DIST).tar.gz build/reproduce

clean: ## remove build/
	rm -rf build

help: ## this list
	@sed -n 's/^\([a-z-]*\):.*## \(.*\)/\1|\2/p' Makefile | awk -F'|' '{printf "make %-16s %s\n", $$1, $$2}'

# $(call need,packages): install those that are missing.
define need
	@missing=$$(for p in $(1); do dpkg-query -W -f='$${Status}' $$p 2>/dev/null | grep -q 'ok installed' || echo $$p; done); \
	[ -z "$$missing" ] && exit 0; \
	if [ "$$(id -u)" = 0 ]; then as=; elif command -v sudo >/dev/null; then as=sudo; else \
	    echo "these Debian packages are missing and neither root nor sudo is at hand to install them:" $$missing >&2; exit 1; fi; \
	echo "installing:" $$missing; \
	$$as env DEBIAN_FRONTEND=noninteractive sh -c "apt-get update -q && apt-get install -y -q --no-install-recommends $$(echo $$missing)"
endef

packages:
	$(call need,$(BUILD_PACKAGES))

cluster-packages:
	$(call need,$(CLUSTER_PACKAGES))

check-packages:
	$(call need,$(CHECK_PACKAGES))

$(OBJ)/%.c.o: src/%.c
	@mkdir -p $(@D)
	@echo "  CC   $<"
	@$(SAME_LTO)$(CC) $(CFLAGS) $(HARDEN) $(if $(SAME_LTO),-frandom-seed=$<) -c $< -o $@

$(OBJ)/%.cpp.o: src/%.cpp
	@mkdir -p $(@D)
	@echo "  CXX  $<"
	@$(CXX) $(CXXFLAGS) $(HARDEN) -c $< -o $@

# The file's bytes and a NUL as an array that is called like the file.
name = $(subst .,_,$(notdir $<))
$(patsubst src/%,$(OBJ)/%.o,$(EMBEDDED)): $(OBJ)/%.o: src/%
	@mkdir -p $(@D)
	@echo "  TEXT $<"
	@printf '%s\n' '.section .rodata' '.globl $(name)' '$(name): .incbin "$<"' '.byte 0' \
	    '.section .note.GNU-stack,"",@progbits' | $(CC) -x assembler -c - -o $@

# The library of species, as src/scene/species_file.c reads it.
$(OBJ)/species_library.o: $(SPECIES)
	@mkdir -p $(@D)
	@echo "  TEXT scenes/species"
	@{ printf '%s\n' '.section .rodata' '.globl species_library' 'species_library:'; \
	   for f in $(SPECIES); do printf '.asciz "%s"\n.incbin "%s"\n.byte 0\n' "$$(basename $$f .yaml)" "$$f"; done; \
	   printf '%s\n' '.byte 0' '.section .note.GNU-stack,"",@progbits'; } | $(CC) -x assembler -c - -o $@

# Made anew only if the commit is another one.
.PHONY: commit
$(OBJ)/commit.txt: commit
	@mkdir -p $(@D)
	@echo '$(COMMIT)' | cmp -s - $@ || echo '$(COMMIT)' > $@
$(OBJ)/commit.o: $(OBJ)/commit.txt
	@printf '%s\n' '.section .rodata' '.globl program_commit' 'program_commit: .asciz "$(COMMIT)"' \
	    '.section .note.GNU-stack,"",@progbits' | $(CC) -x assembler -c - -o $@

$(OUT)/libramify.a: $(LIB_OBJ)
	@echo "  AR   $@"
	@rm -f $@ && ar rcsD $@ $^

# Only ramify_* can be seen from outside.
$(OUT)/libramify.so: $(LIB_OBJ) src/ramify.map | $(PLUGIN_FILES)
	@echo "  LINK $@"
	@$(CC) -shared -Wl,-soname,$(SONAME) $(LIB_OBJ) -Wl,--version-script=src/ramify.map $(LDFLAGS) $(RUNPATH_LIBRARY) $(LDLIBS) -o $@
	@ln -sf $(@F) $(OUT)/$(SONAME)

# Only its tables can be seen from outside.
define plugin_rule
$(OUT)/ramify-$(1).so: $(PLUGIN_$(1):%=$(OBJ)/%.o) $(OUT)/libramify.a src/plugin.map
	@echo "  LINK $$@"
	@$$(CC) -shared -Wl,-soname,ramify-$(1).so $(PLUGIN_$(1):%=$(OBJ)/%.o) $(OUT)/libramify.a -Wl,--version-script=src/plugin.map \
	    $(if $(filter sanitize,$(CONFIG)),,-Wl,-z,defs) $$(LDFLAGS) -fno-lto $(LDLIBS_$(1)) -o $$@
endef
$(foreach p,$(PLUGINS),$(eval $(call plugin_rule,$p)))

# A program and its plug-ins must be of one build.
$(OUT)/ramify: $(CLI_OBJ) $(OUT)/libramify.a | $(PLUGIN_FILES)
	@echo "  LINK $@"
	@$(SAME_LTO)$(CC) -pie $^ $(LDFLAGS) $(if $(SAME_LTO),-frandom-seed=ramify) $(RUNPATH_PROGRAM) $(LDLIBS) -o $@

# Its allocations are counted, and one of them fails.
$(OUT)/tests/api/test_memory: private LDFLAGS += -Wl,--wrap=memory_alloc,--wrap=memory_alloc_zero,--wrap=memory_reserve

# A stand-in for Open Image Denoise's library, of either version.
$(OUT)/tests/image/fake_oidn_%.so: tests/image/fake_oidn.c
	@mkdir -p $(@D)
	@echo "  TEST $@"
	@$(CC) -std=c17 -shared -fPIC -Wall -Wextra -Werror -DVERSION=$* $< -o $@
$(OUT)/tests/image/test_oidn: $(OUT)/tests/image/fake_oidn_1.so $(OUT)/tests/image/fake_oidn_2.so

# The command writes its own manual.
$(OUT)/man/ramify.1: $(OUT)/ramify
	@mkdir -p $(@D)
	@echo "  MAN  $@"
	@$< help --man > $@

$(OUT)/man/ramify-%.1: $(OUT)/ramify
	@mkdir -p $(@D)
	@echo "  MAN  $@"
	@$< help $* --man > $@

$(OUT)/completion/ramify: $(OUT)/ramify
	@mkdir -p $(@D)
	@$< completion bash > $@

$(OUT)/completion/_ramify: $(OUT)/ramify
	@mkdir -p $(@D)
	@$< completion zsh > $@

$(OUT)/tests/%: tests/%.c $(OUT)/libramify.a | $(PLUGIN_FILES)
	@mkdir -p $(@D)
	@echo "  TEST $<"
	@$(CC) $(CFLAGS) -Itests $< $(OUT)/libramify.a $(LDFLAGS) $(RUNPATH_TEST) -lcmocka $(LDLIBS) -o $@

# Reads what the targets of libFuzzer read, plug-ins and all.
CORPUS_OBJ := $(PLUGIN_oiio:%=$(OBJ)/%.o) $(PLUGIN_vdb:%=$(OBJ)/%.o)
$(OUT)/tests/fuzz/test_corpus: tests/fuzz/test_corpus.c $(wildcard tests/fuzz/fuzz*.[ch]) $(CORPUS_OBJ) $(OUT)/libramify.a | $(PLUGIN_FILES)
	@mkdir -p $(@D)
	@echo "  TEST $<"
	@$(CC) $(CFLAGS) -Itests $< $(CORPUS_OBJ) $(OUT)/libramify.a $(LDFLAGS) $(RUNPATH_TEST) -lcmocka $(LDLIBS) $(LDLIBS_oiio) \
	    $(LDLIBS_vdb) -o $@

# What a child process runs is linked in, plug-ins and all.
FUZZ_PLUGIN_picture := oiio
FUZZ_PLUGIN_vdb     := vdb
define fuzz_rule
build/fuzz/fuzz_$(1): tests/fuzz/fuzz_$(1).c tests/fuzz/fuzz.h $(OUT)/libramify.a $(PLUGIN_$(FUZZ_PLUGIN_$(1)):%=$(OBJ)/%.o)
	@echo "  FUZZ $$<"
	@$$(CC) $$(CFLAGS) -Itests $$< $$(filter %.o,$$^) $(OUT)/libramify.a -fsanitize=fuzzer,address,undefined -fsanitize-link-c++-runtime $$(LDLIBS) \
	    $$(LDLIBS_$(FUZZ_PLUGIN_$(1))) -o $$@
endef
$(foreach t,$(FUZZ_TARGETS),$(eval $(call fuzz_rule,$t)))

# As a host's program: only what ramify.h has.
$(OUT)/tests/soak/soak: tests/soak/soak.c $(OUT)/libramify.so
	@mkdir -p $(@D)
	@echo "  TEST $<"
	@$(CC) $(CFLAGS) $< -L$(OUT) -lramify $(RUNPATH_TEST) -o $@

# So many programs, each of which would optimize the path tracer anew. gold links them in half the time, and in a quarter
# without what debuggers read.
GOLD   := $(if $(filter release,$(CONFIG)),$(if $(shell command -v ld.gold),-fuse-ld=gold))
$(TEST_BIN) $(OUT)/tests/cross/compare: private LDFLAGS += -fno-lto $(GOLD) $(if $(UNREAD),-Wl$(,)--strip-debug)
# They spend their time in the library: compiled with little optimization they are there sooner. What it then knows of
# loops is too little to tell what they leave uninitialized.
$(TEST_BIN): private CFLAGS += -O1 -Wno-maybe-uninitialized

-include $(LIB_OBJ:.o=.d) $(PLUGIN_OBJ:.o=.d) $(CLI_OBJ:.o=.d) $(addsuffix .d,$(TEST_BIN) $(BENCH_BIN))
