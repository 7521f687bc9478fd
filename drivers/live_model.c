/* What libwacom's data says about a tablet. */
#include "live.h"

#include <libwacom/libwacom.h>

enum { VENDOR_WACOM = 0x056a };

/* Wacom's products have ids of their own; elsewhere many share one, and only the name tells. */
static WacomDevice *device_find(WacomDeviceDatabase *models, const struct live_node *node)
{
	if (node->told.vendor == VENDOR_WACOM)
		return libwacom_new_from_usbid(models, node->told.vendor, node->told.product, NULL);
	return libwacom_new_from_name(models, node->told.name, NULL);
}

bool live_model_find(const struct live_node *node, float *width_mm, float *height_mm, bool *display)
{
	WacomDeviceDatabase *models = libwacom_database_new();
	WacomDevice *device = models ? device_find(models, node) : NULL;
	if (device) {
		*width_mm = 25.4f * (float)libwacom_get_width(device);
		*height_mm = 25.4f * (float)libwacom_get_height(device);
		*display = libwacom_get_integration_flags(device) & WACOM_DEVICE_INTEGRATED_DISPLAY;
		libwacom_destroy(device);
	}
	if (models)
		libwacom_database_destroy(models);
	return device != NULL;
}
