// Inlines scripts and styles: each page is a single file that opens from disk and can be mailed.
import { defineConfig, type Plugin } from "vite";

function inlineAssets(): Plugin {
  return {
    name: "inline-assets",
    enforce: "post",
    generateBundle(_options, bundle) {
      const page = Object.values(bundle).find((file) => file.fileName.endsWith(".html"));
      if (!page || page.type !== "asset") throw new Error("no page was built");
      let html = String(page.source);
      for (const file of Object.values(bundle)) {
        if (file === page) continue;
        if (file.type === "chunk") {
          html = html.replace(/<script[^>]*\bsrc="[^"]*"[^>]*><\/script>/, "");
          html = html.replace("</body>", () => `<script type="module">${file.code.replaceAll("</script", "<\\/script")}</script>\n</body>`);
        } else if (file.fileName.endsWith(".css")) {
          html = html.replace(/<link rel="stylesheet"[^>]*>/, () => `<style>${String(file.source)}</style>`);
        }
        delete bundle[file.fileName];
      }
      page.source = html;
    },
  };
}

export default defineConfig({
  base: "./",
  build: {
    outDir: "dist",
    target: "es2022",
    modulePreload: false,
    assetsInlineLimit: 1 << 20,
    cssCodeSplit: false,
    rollupOptions: { input: `${process.env.PAGE ?? "atlas"}.html` },
  },
  plugins: [inlineAssets()],
  server: { host: "127.0.0.1" }, // for the tests, without resolving a host name
  // Generous limits, as software rendering is slow. No parallel files: each starts a browser that uses all processors.
  test: {
    include: ["tests/**/*.test.ts"],
    testTimeout: 240_000,
    hookTimeout: 240_000,
    fileParallelism: false,
    expect: { poll: { timeout: 60_000 } },
  },
} as Parameters<typeof defineConfig>[0]);
