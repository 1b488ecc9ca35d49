"""swt over the whole body and all planes: the surface line's assumptions left out."""
