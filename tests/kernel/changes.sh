# What the kernel bench changes in Debian's source, read by build.sh: change FILE SED-SCRIPT.

# A host with AMX has registers of 11 KB; a program's would not fit, and it would die at once.
change arch/x86/um/user-offsets.c 's/DEFINE_LONGS(HOST_FP_SIZE, 2696)/DEFINE_LONGS(HOST_FP_SIZE, 11264)/'

# Edges of gpio-sim come with the tick; at 100 Hz two of them in 10 ms would be one.
change arch/um/Kconfig '/^config HZ$/,/^$/s/default 100$/default 1000/'

# The display and its writeback connector may show the same picture: 6.12 does not say so itself.
change drivers/gpu/drm/vkms/vkms_output.c '/^\tdrm_mode_config_reset(dev);/i\
\tif (vkmsdev->config->writeback)\
\t\tencoder->possible_clones = output->wb_connector.encoder.possible_clones =\
\t\t\tdrm_encoder_mask(encoder) | drm_encoder_mask(\&output->wb_connector.encoder);\
'
