import { defineConfig, type Plugin } from 'vite';

// The exporter of single files finds the two references by their exact text.
const plainReferences: Plugin = {
  name: 'plain-references',
  enforce: 'post',
  transformIndexHtml: (html) => html.replaceAll(' crossorigin', ''),
};

export default defineConfig({
  base: '/',
  publicDir: false,
  plugins: [plainReferences],
  build: {
    target: 'es2022',
    sourcemap: false,
    modulePreload: false,
    cssCodeSplit: false,
    assetsInlineLimit: 0,
    chunkSizeWarningLimit: 2000,
    rolldownOptions: {
      output: {
        codeSplitting: false,
        entryFileNames: 'page.js',
        assetFileNames: 'page.[ext]',
      },
    },
  },
});
