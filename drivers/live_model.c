/* What libwacom's data says about a tablet. */
#include "live_private.h"

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

const struct live_model *live_model_remembered(struct live_models *models,
					       const struct live_node *node)
{
	const struct tape_device *told = &node->told;
	for (int i = 0; i < MODELS_MAX; i++) {
		const struct live_model *model = &models->model[i];
		if (i < models->asked && model->vendor == told->vendor &&
		    model->product == told->product && !strcmp(model->name, told->name))
			return model;
	}
	struct live_model *model = &models->model[models->asked++ % MODELS_MAX];
	*model = (struct live_model){.vendor = told->vendor, .product = told->product};
	memcpy(model->name, told->name, sizeof model->name);
	model->known = live_model_find(node, &model->width_mm, &model->height_mm, &model->display);
	return model;
}
