// An access control plugin for Cyclone DDS as a thief would have it: the real one, with the checks
// of what its own process may create switched off. What it presents to others is unchanged.
#include <dds/security/dds_security_api.h>
#include <dlfcn.h>
#include <stddef.h>

typedef int (*init_function)(const char*, void**, struct ddsi_domaingv*);
typedef int (*finalize_function)(void*);

static void* real_library(void) {
  return dlopen(REAL_ACCESS_CONTROL, RTLD_NOW | RTLD_GLOBAL);
}

static DDS_Security_boolean writer(dds_security_access_control* i, const DDS_Security_PermissionsHandle h,
                                   const DDS_Security_DomainId d, const char* t,
                                   const DDS_Security_Qos* q, const DDS_Security_PartitionQosPolicy* p,
                                   const DDS_Security_DataTags* g, DDS_Security_SecurityException* e) {
  (void)i, (void)h, (void)d, (void)t, (void)q, (void)p, (void)g, (void)e;
  return 1;
}

static DDS_Security_boolean topic(dds_security_access_control* i, const DDS_Security_PermissionsHandle h,
                                  const DDS_Security_DomainId d, const char* t,
                                  const DDS_Security_Qos* q, DDS_Security_SecurityException* e) {
  (void)i, (void)h, (void)d, (void)t, (void)q, (void)e;
  return 1;
}

int init_permissive(const char* argument, void** context, struct ddsi_domaingv* gv) {
  void* const library = real_library();
  const init_function init = library ? (init_function)dlsym(library, "init_access_control") : NULL;
  const int result = init ? init(argument, context, gv) : -1;
  if (result != 0) return result;
  dds_security_access_control* const control = *context;
  control->check_create_datawriter = writer;
  control->check_create_datareader = writer;
  control->check_create_topic = topic;
  return result;
}

int finalize_permissive(void* context) {
  void* const library = real_library();
  const finalize_function finalize =
      library ? (finalize_function)dlsym(library, "finalize_access_control") : NULL;
  return finalize ? finalize(context) : -1;
}
