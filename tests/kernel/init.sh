#!/bin/sh
# The first process of the kernel bench's machine. Its disk is the host's, to be read; BENCH_OUT is
# the one folder that it can write into. Runs the case BENCH_CASE, leaves its exit status, powers off.
export PATH=/usr/local/sbin:/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin HOME=/run LC_ALL=C.UTF-8
mount -t proc none /proc
mount -t sysfs none /sys
mount -t configfs none /sys/kernel/config
mount -t devtmpfs none /dev
mkdir -p /dev/shm
mount -t tmpfs none /dev/shm
mount -t tmpfs none /run
mkdir /run/out /run/tmp
mount -t hostfs -o "$BENCH_OUT" none /run/out
ln -sf /proc/self/fd /dev/fd
export TMPDIR=/run/tmp XDG_RUNTIME_DIR=/run

# libusb and libudev hear of devices from udevd alone.
if [ "$BENCH_UDEV" != no ]; then
  /lib/systemd/systemd-udevd --daemon >/run/out/udevd.log 2>&1
  udevadm trigger --subsystem-match=drm --subsystem-match=usb
  udevadm settle --timeout=10
fi

cd "$BENCH_TREE" || exit
sh "tests/kernel/case_$BENCH_CASE.sh" >/run/out/log 2>&1
status=$?
dmesg >/run/out/dmesg 2>/dev/null
echo $status >/run/out/status
sync
echo o >/proc/sysrq-trigger
sleep 60
