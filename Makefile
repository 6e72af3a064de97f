# make check   sets the machine up, builds the program and checks the whole book
# make test    sets the machine up and runs all tests
# make bench   times parsing, evaluation and the special functions
# make rivals  compares the special functions with other programs, where they are installed
#
# The first build on a machine compiles GMP and MPFR and runs their own tests: about five minutes,
# once, kept in ~/.cache/gmp-mpfr-sys for every later build.

SHELL := /bin/bash
CARGO ?= cargo
export PATH := $(PATH):$(HOME)/.cargo/bin

.PHONY: check test bench rivals tools

check: tools
	$(CARGO) build --release --locked
	"$${CARGO_TARGET_DIR:-target}/release/claimcheck" check $(ARGS)

test: tools
	$(CARGO) test --locked $(ARGS)

bench: tools
	$(CARGO) bench --locked $(ARGS)

rivals: tools
	python3 benches/rivals/run.py $(ARGS)

# GMP's build needs a C compiler, m4 and diffutils (diff, cmp); m4 and gcc are missing on a plain Debian.
tools:
	@command -v $(CARGO) >/dev/null || { echo "cargo is missing: install Rust 1.91 or newer, https://rustup.rs" >&2; exit 1; }
	@missing=; \
	command -v cc   >/dev/null || missing="$$missing gcc libc6-dev"; \
	command -v m4   >/dev/null || missing="$$missing m4"; \
	command -v cmp  >/dev/null || missing="$$missing diffutils"; \
	if [ -z "$$missing" ]; then exit 0; fi; \
	sudo=; [ "$$(id -u)" = 0 ] || sudo="sudo -n"; \
	if command -v apt-get >/dev/null && { [ -z "$$sudo" ] || $$sudo true 2>/dev/null; }; then \
		echo "installing$$missing"; \
		$$sudo apt-get update -q && \
		DEBIAN_FRONTEND=noninteractive $$sudo apt-get install -q -y --no-install-recommends $$missing; \
	else \
		echo "the build of GMP and MPFR needs$$missing: install them with your package manager, then run make again" >&2; \
		exit 1; \
	fi
