"""Loaded by environments older than the plugin's name, orientation_audit_plugin (cure: make setup)."""
